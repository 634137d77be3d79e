// "Specular Material": a perfect mirror ball.
#include "figures.h"
#include "scene_parts.h"

namespace limn::figures {

Figure fig10_specular(const FigureInputs&) {
    return {.name = __func__,
            .scene = ball_on_checker(std::make_shared<Metal>(Color{.7, .6, .5})),
            .camera = ball_on_checker_camera(),
            .settings = {.samples_per_pixel = 300}};
}

}  // namespace limn::figures
