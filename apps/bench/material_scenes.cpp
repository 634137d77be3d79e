#include "bench/material_scenes.h"

#include <cmath>
#include <numbers>

#include "bench/scenes.h"
#include "limn/limn.h"
#include "parts.h"
#include "scene_parts.h"

namespace limn::bench {

namespace {

using figures::matte;

constexpr double kShareOfTwoMillion = 0.035;  // 69312 triangles

// The sky with its sun in the pixels within two degrees of it, of the same irradiance.
EnvironmentMap sky_with_sun(const SkySettings& settings) {
    const Sky sky = make_sky(settings);
    Image map = *sky.environment->image();
    const Vec3 to_sun = normalize(settings.to_sun);
    const double least = std::cos(2 * std::numbers::pi / 180);
    const int width = map.width(), height = map.height();
    // The middle of pixel (x, y), and its solid angle.
    const auto direction = [&](int x, int y) {
        const double theta = std::numbers::pi * (y + 0.5) / height, phi = 2 * std::numbers::pi * (x + 0.5) / width;
        return Vec3{-std::sin(phi) * std::sin(theta), std::cos(theta), std::cos(phi) * std::sin(theta)};
    };
    const auto solid_angle = [&](int y) {
        const double step = std::numbers::pi / height;
        return (std::cos(step * y) - std::cos(step * (y + 1))) * 2 * std::numbers::pi / width;
    };
    double whole = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (dot(direction(x, y), to_sun) > least) whole += solid_angle(y);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (dot(direction(x, y), to_sun) > least)
                map.set(x, y, map.at(x, y) + sky.sun.irradiance / (whole * sky.environment->scale()));
    return EnvironmentMap(std::move(map), {}, sky.environment->scale());
}

}  // namespace

std::shared_ptr<const Mesh> hilly_ball(const Point3& center, double radius, std::shared_ptr<const Material> material) {
    MeshData data = make_scene("sphere", kShareOfTwoMillion).mesh->data();
    const auto place = [radius](float coordinate, double middle) {
        return static_cast<float>(middle + radius * static_cast<double>(coordinate));
    };
    for (Float3& v : data.vertices) v = {place(v.x, center.x), place(v.y, center.y), place(v.z, center.z)};
    return std::make_shared<Mesh>(std::move(data), std::move(material));
}

Figure rough_copper() {
    Figure figure;
    figure.scene.add(std::make_shared<Quad>(Point3{-20, -1, -20}, Vec3{0, 0, 40}, Vec3{40, 0, 0}, matte({.4, .4, .4})));
    figure.scene.add(hilly_ball({0, 0, 0}, 1, std::make_shared<RoughConductor>(gallery::kCopper, 0.2)));
    figure.scene.environment = std::make_shared<EnvironmentMap>(sky_with_sun({}));
    figure.camera = {.look_from = {0, 1.5, 5}, .look_at = {0, -.1, 0}, .vertical_fov = 30};
    return figure;
}

Figure rough_glass() {
    Figure figure;
    figure.scene = figures::cornell_room(figures::cornell_lamp());
    figure.camera = figures::cornell_camera();
    figure.scene.add(figures::tall_box(matte({.73, .73, .73})));
    figure.scene.add(std::make_shared<Sphere>(Point3{190, 110, 170}, 100, std::make_shared<RoughDielectric>(1.5, 0.5)));
    return figure;
}

Figure still_life() {
    const Model model = gallery::load("still_life.glb");
    Figure figure;
    figure.scene.add(model);
    figure.scene.background = Background::constant({.05, .06, .08});
    figure.camera = model.cameras.front().camera;
    return figure;
}

}  // namespace limn::bench
