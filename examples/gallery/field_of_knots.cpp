#include <array>
#include <random>

#include "gallery.h"
#include "parts.h"

namespace limn::gallery {

Figure field_of_knots() {
    // Make a mesh of each material.
    constexpr int kAcross = 20, kAlong = 20;
    constexpr double kSpacing = 4.4;
    const auto plastic = [](const Color& color) { return std::make_shared<Plastic>(color, 0.3); };
    const std::array<std::shared_ptr<const Material>, 5> materials{
        plastic({.75, .12, .06}), plastic({.9, .85, .75}), plastic({.05, .2, .3}), plastic({.85, .5, .06}),
        std::make_shared<RoughConductor>(Color{1, .78, .34}, Roughness{.45})};
    std::array<std::shared_ptr<const Mesh>, materials.size()> knots;
    knots[0] = knot(materials[0]);
    for (std::size_t i = 1; i < knots.size(); ++i)  // all meshes share the triangles of the first
        knots[i] = std::make_shared<Mesh>(*knots[0], std::vector{materials[i]});

    // Place the knots in rows, each turned by a random angle.
    Figure figure;
    figure.name = __func__;
    Scene& scene = figure.scene;
    std::mt19937 random(5);  // gives the same numbers with every compiler, unlike the distributions of <random>
    const auto below = [&random](double most) { return most * static_cast<double>(random()) / 0x1p32; };
    for (int i = 0; i < kAcross; ++i)
        for (int k = 0; k < kAlong; ++k) {
            const double x = kSpacing * (i - kAcross / 2 + 0.5 * (k % 2)), z = -kSpacing * k;
            const Transform turned = Transform::rotate_y(below(360)) * Transform::rotate_x(below(90));
            scene.add(std::make_shared<Instance>(knots[random() % knots.size()],
                                                 Transform::translate({x, 1.8 + below(.4), z}) * turned));
        }
    // Add the ground, the sky and the camera.
    scene.add(std::make_shared<Disk>(Point3{0, -.6, 0}, Vec3{0, 1, 0}, 1000,
                                     std::make_shared<Lambertian>(Color{.35, .33, .3})));
    Sky sky = make_sky({.to_sun = {.8, .6, .3}});
    sky.sun.angular_radius = 5;  // larger than the Sun, for softer shadows
    scene.environment = sky.environment;
    scene.add(sky.sun);
    figure.camera = {.look_from = {0, 9, 22}, .look_at = {0, 1, -14}, .vertical_fov = 28, .aperture_angle = 2.2};
    figure.camera.focus_distance = 33;
    return figure;
}

}  // namespace limn::gallery
