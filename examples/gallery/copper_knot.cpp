#include "gallery.h"
#include "parts.h"

namespace limn::gallery {

Figure copper_knot() {
    // Johnson and Christy, Optical Constants of the Noble Metals, Physical Review B 6, 1972, at 650, 550 and 450 nm.
    const ComplexIndex copper{{0.21, 1.04, 1.17}, {3.67, 2.59, 2.36}};
    Figure figure;
    figure.name = __func__;
    Scene& scene = figure.scene;
    const auto metal = knot(std::make_shared<RoughConductor>(copper, Roughness{.35}));
    const double floor = metal->bounds().lower.y;
    scene.add(metal);
    scene.add(std::make_shared<Disk>(Point3{0, floor, 0}, Vec3{0, 1, 0}, 60,
                                     std::make_shared<Plastic>(Color{.1, .11, .13}, 0.4)));
    Sky sky = make_sky({.to_sun = {-1, .75, .7}});
    sky.sun.angular_radius = 3;  // a hazy one, of softer shadows
    scene.environment = sky.environment;
    scene.add(sky.sun);
    figure.camera = {.look_from = {1.6, 2.4, 8}, .look_at = {.15, -.15, 0}, .vertical_fov = 29};
    return figure;
}

}  // namespace limn::gallery
