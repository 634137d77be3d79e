// "Diffuse Material" (emissive): marble in the dark, lit by a spherical and a rectangular lamp.
#include "figures.h"
#include "scene_parts.h"

namespace limn::figures {

Figure fig12_emissive(const FigureInputs&) {
    return {.name = __func__,
            .scene = stone_under_lamps(marbled(4)),
            .camera = {.look_from = {26, 3, 6}, .look_at = {0, 2, 0}, .vertical_fov = 20},
            .settings = {.samples_per_pixel = 300}};
}

}  // namespace limn::figures
