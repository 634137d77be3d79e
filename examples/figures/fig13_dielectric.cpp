// "Dielectric Material": glass with a bubble in it, beside a matte and a gold ball.
#include "figures.h"
#include "scene_parts.h"

namespace limn::figures {

Figure fig13_dielectric(const FigureInputs&) {
    const auto glass = std::make_shared<Dielectric>(1.5, Fresnel::schlick);
    const auto gold = std::make_shared<Metal>(Color{.8, .6, .2}, .3);
    Scene scene;
    scene.background = kFirstBookSky;
    scene.add(std::make_shared<Sphere>(Point3{0, -100.5, -1}, 100.0, matte({.8, .8, 0})));
    scene.add(std::make_shared<Sphere>(Point3{0, 0, -1}, .5, matte({.1, .2, .5})));
    scene.add(std::make_shared<Sphere>(Point3{-1, 0, -1}, .5, glass));
    scene.add(std::make_shared<Sphere>(Point3{-1, 0, -1}, -.4, glass));  // the bubble: its outside is within
    scene.add(std::make_shared<Sphere>(Point3{1, 0, -1}, .5, gold));
    return {.name = __func__,
            .scene = std::move(scene),
            .camera = {.look_from = {-2, 2, 1}, .look_at = {0, 0, -1}, .vertical_fov = 35},
            .settings = {.samples_per_pixel = 400}};
}

}  // namespace limn::figures
