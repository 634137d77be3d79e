// "Looking from point3(13, 2, 3)": about 480 balls. Many of them rise while the shutter is open.
#include "figure_data.h"
#include "figures.h"
#include "scene_parts.h"

namespace limn::figures {

Figure fig01_bouncing_spheres(const FigureInputs&) {
    return {.name = __func__,
            .scene = balls_on_checker(read_bouncing_spheres(data_file("bounce_spheres.csv")), Fresnel::schlick),
            .camera = {.look_from = {13, 2, 3}, .vertical_fov = 20, .aperture_angle = 0.6, .focus_distance = 10},
            .settings = {.samples_per_pixel = 250}};
}

}  // namespace limn::figures
