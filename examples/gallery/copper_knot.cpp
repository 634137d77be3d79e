#include "gallery.h"
#include "parts.h"

namespace limn::gallery {

Figure copper_knot() {
    Figure figure;
    figure.name = __func__;
    Scene& scene = figure.scene;
    const auto metal = knot(std::make_shared<RoughConductor>(kCopper, Roughness{.35}));
    const double floor = metal->bounds().lower.y;
    scene.add(metal);
    scene.add(std::make_shared<Disk>(Point3{0, floor, 0}, Vec3{0, 1, 0}, 60,
                                     std::make_shared<Plastic>(Color{.1, .11, .13}, 0.4)));
    Sky sky = make_sky({.to_sun = {-1, .75, .7}});
    sky.sun.angular_radius = 3;  // larger than the Sun, for softer shadows
    scene.environment = sky.environment;
    scene.add(sky.sun);
    figure.camera = {.look_from = {1.6, 2.4, 8}, .look_at = {.15, -.15, 0}, .vertical_fov = 29};
    return figure;
}

}  // namespace limn::gallery
