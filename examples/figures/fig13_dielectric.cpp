// "Dielectric Material": a glass ball with a bubble in it, a matte ball and a gold ball.
#include "figures.h"
#include "scene_parts.h"

namespace limn::figures {

Figure fig13_dielectric(const FigureInputs&) {
    const auto glass = std::make_shared<Dielectric>(1.5, Fresnel::schlick);
    const auto gold = std::make_shared<Metal>(Color{.8, .6, .2}, .3);
    return {.name = __func__,
            .scene = three_balls(glass, gold),
            .camera = {.look_from = {-2, 2, 1}, .look_at = {0, 0, -1}, .vertical_fov = 35},
            .settings = {.samples_per_pixel = 400}};
}

}  // namespace limn::figures
