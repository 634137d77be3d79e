// "Checkered Texture on Triangle": a checkered triangle. It is at z = 0.1, because z = 0 is a boundary between cells of
// the texture.
#include "figures.h"
#include "scene_parts.h"

namespace limn::figures {

Figure fig09_checkered_triangle(const FigureInputs&) {
    Scene scene;
    scene.background = kSecondBookSky;
    scene.add(std::make_shared<Triangle>(Point3{-2, -1.5, .1}, Point3{2, -1.5, .1}, Point3{0, 2, .1}, checkered(0.5)));
    return {.name = __func__,
            .scene = std::move(scene),
            .camera = {.look_from = {0, 0, 9}, .vertical_fov = 30},
            .settings = {.samples_per_pixel = 100}};
}

}  // namespace limn::figures
