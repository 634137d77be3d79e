#include "gallery.h"
#include "parts.h"

namespace limn::gallery {

Figure sunlit_room() {
    // Define colours and sizes.
    constexpr Color kWhite{.75, .75, .7}, kWood{.5, .3, .15}, kRed{.55, .14, .08};
    constexpr double kWidth = 4, kHeight = 2.6, kDepth = 5;          // in metres
    constexpr double kSill = .9, kTop = 2.2, kNear = 1.2, kFar = 3;  // edges of the window in the wall x = kWidth
    Figure figure;
    figure.name = __func__;
    Scene& scene = figure.scene;
    const auto wall = [&scene](const Point3& corner, const Vec3& u, const Vec3& v, const Color& color) {
        scene.add(std::make_shared<Quad>(corner, u, v, std::make_shared<Lambertian>(color)));
    };
    // Add floor, ceiling and walls. The wall with the window consists of four quads.
    wall({0, 0, 0}, {0, 0, kDepth}, {kWidth, 0, 0}, kWood);
    wall({0, kHeight, 0}, {kWidth, 0, 0}, {0, 0, kDepth}, kWhite);
    wall({0, 0, 0}, {0, kHeight, 0}, {0, 0, kDepth}, kRed);
    wall({0, 0, 0}, {kWidth, 0, 0}, {0, kHeight, 0}, kWhite);
    wall({0, 0, kDepth}, {0, kHeight, 0}, {kWidth, 0, 0}, kWhite);
    wall({kWidth, 0, 0}, {0, 0, kDepth}, {0, kSill, 0}, kWhite);
    wall({kWidth, kTop, 0}, {0, 0, kDepth}, {0, kHeight - kTop, 0}, kWhite);
    wall({kWidth, kSill, 0}, {0, 0, kNear}, {0, kTop - kSill, 0}, kWhite);
    wall({kWidth, kSill, kFar}, {0, 0, kDepth - kFar}, {0, kTop - kSill, 0}, kWhite);

    // Put the knot on the floor, 1.1 m high.
    const auto clay = knot(std::make_shared<Lambertian>(Color{.6, .55, .45}));
    const Box box = clay->bounds();
    const double scale = 1.1 / box.diagonal().y;
    scene.add(std::make_shared<Instance>(clay, Transform::translate({1.5, -scale * box.lower.y, 1.9}) *
                                                   Transform::rotate_y(25) * Transform::scale(scale, scale, scale)));
    // Add the sky and the camera.
    const Sky sky = make_sky({.to_sun = {1, .8, .25}, .scale = .1});
    scene.environment = sky.environment;
    scene.add(sky.sun);
    figure.camera = {.look_from = {2.2, 1.4, 4.95}, .look_at = {1.8, 1.1, 0}, .vertical_fov = 55};
    return figure;
}

}  // namespace limn::gallery
