// "Perlin Texture on Sphere": a marble ball on marble ground.
#include "figures.h"
#include "scene_parts.h"

namespace limn::figures {

Figure fig07_perlin_sphere(const FigureInputs&) {
    const auto marble = marbled(4);
    Scene scene;
    scene.background = kSecondBookSky;
    scene.add(std::make_shared<Sphere>(Point3{0, -1000, 0}, 1000.0, marble));
    scene.add(std::make_shared<Sphere>(Point3{0, 2, 0}, 2.0, marble));
    return {.name = __func__,
            .scene = std::move(scene),
            .camera = {.look_from = {13, 2, 3}, .vertical_fov = 20},
            .settings = {.samples_per_pixel = 200}};
}

}  // namespace limn::figures
