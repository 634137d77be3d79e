// "Cornell Box".
#include "figures.h"
#include "scene_parts.h"

namespace limn::figures {

Figure fig15_cornell_box(const FigureInputs&) {
    const auto lamp = std::make_shared<DiffuseLight>(Color{15, 15, 15});
    const auto white = matte({.73, .73, .73});
    Scene scene = cornell_room(std::make_shared<Quad>(Point3{343, 554, 332}, Vec3{-130, 0, 0}, Vec3{0, 0, -105}, lamp));
    scene.add(tall_box(white));
    scene.add(short_box(white));
    return {.name = __func__,
            .scene = std::move(scene),
            .camera = cornell_camera(),
            .settings = {.samples_per_pixel = 100}};
}

}  // namespace limn::figures
