// "Diffuse Material" (emissive): marble lit by a ball and a pane of light in the dark.
#include "figures.h"
#include "scene_parts.h"

namespace limn::figures {

Figure fig12_emissive(const FigureInputs&) {
    const auto marble = marbled(4);
    const auto light = std::make_shared<DiffuseLight>(Color{4, 4, 4});
    Scene scene;
    scene.add(std::make_shared<Sphere>(Point3{0, -1000, 0}, 1000.0, marble));
    scene.add(std::make_shared<Sphere>(Point3{0, 2, 0}, 2.0, marble));
    scene.add(std::make_shared<Sphere>(Point3{0, 7, 0}, 2.0, light));
    scene.add(std::make_shared<Quad>(Point3{3, 1, -2}, Vec3{2, 0, 0}, Vec3{0, 2, 0}, light));
    return {.name = __func__,
            .scene = std::move(scene),
            .camera = {.look_from = {26, 3, 6}, .look_at = {0, 2, 0}, .vertical_fov = 20},
            .settings = {.samples_per_pixel = 300}};
}

}  // namespace limn::figures
