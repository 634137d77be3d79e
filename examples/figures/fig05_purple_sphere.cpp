// "Purple Sphere": a matte sphere on a grey ground.
#include "figures.h"
#include "scene_parts.h"

namespace limn::figures {

Figure fig05_purple_sphere(const FigureInputs&) {
    Scene scene;
    scene.background = kSecondBookSky;
    scene.add(std::make_shared<Sphere>(Point3{0, 0, -1}, 0.5, matte({.5, 0, .5})));
    scene.add(std::make_shared<Sphere>(Point3{0, -100.5, -1}, 100.0, matte({.5, .5, .5})));
    return {.name = __func__,
            .scene = std::move(scene),
            .camera = {.look_from = {0, 0, 0}, .look_at = {0, 0, -1}, .vertical_fov = 90},
            .settings = {.samples_per_pixel = 200}};
}

}  // namespace limn::figures
