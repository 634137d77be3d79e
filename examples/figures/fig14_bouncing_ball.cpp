// "Bouncing ball": a ball that rises by 1 while the shutter is open, between two balls at rest.
#include "figures.h"
#include "scene_parts.h"

namespace limn::figures {

Figure fig14_bouncing_ball(const FigureInputs&) {
    Scene scene;
    scene.background = kSecondBookSky;
    scene.add(std::make_shared<Sphere>(Point3{0, -1000.4, 0}, 1000.0, checkered(0.32)));
    scene.add(std::make_shared<Sphere>(Point3{0, 0, 0}, Point3{0, 1, 0}, 0.4, matte({.7, .2, .1})));
    scene.add(std::make_shared<Sphere>(Point3{-1.1, 0, 0}, 0.4, matte({.1, .2, .5})));
    scene.add(std::make_shared<Sphere>(Point3{1.1, 0, 0}, 0.4, std::make_shared<Metal>(Color{.7, .6, .5})));
    return {.name = __func__,
            .scene = std::move(scene),
            .camera = {.look_from = {0, .5, 10}, .look_at = {0, .5, 0}, .vertical_fov = 20},
            .settings = {.samples_per_pixel = 300}};
}

}  // namespace limn::figures
