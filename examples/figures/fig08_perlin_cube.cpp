// "Perlin Cube produced with cube.obj": the model data/cube.obj in marble.
#include "figure_data.h"
#include "figures.h"
#include "scene_parts.h"

namespace limn::figures {

Figure fig08_perlin_cube(const FigureInputs&) {
    Scene scene;
    scene.background = kSecondBookSky;
    for (const auto& mesh : load_obj(data_file("cube.obj"), {.default_material = marbled(4)}).meshes) scene.add(mesh);
    return {.name = __func__,
            .scene = std::move(scene),
            .camera = {.look_from = {5, 4, 6}, .vertical_fov = 25},
            .settings = {.samples_per_pixel = 100}};
}

}  // namespace limn::figures
