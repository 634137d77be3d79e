#include "scene_parts.h"

#include "figure_data.h"

namespace limn::figures {

std::shared_ptr<const Material> matte(const Color& albedo) { return std::make_shared<Lambertian>(albedo); }

std::shared_ptr<const Material> checkered(double cell) {
    return std::make_shared<Lambertian>(std::make_shared<Checker>(cell, Color{.2, .3, .1}, Color{.9, .9, .9}));
}

std::shared_ptr<const Material> marbled(double scale) {
    return std::make_shared<Lambertian>(
        std::make_shared<Marble>(scale, read_perlin_lattice(data_file("perlin_lattice.txt"))));
}

Scene ball_on_checker(std::shared_ptr<const Material> ball) {
    Scene scene;
    scene.background = kSecondBookSky;
    scene.add(std::make_shared<Sphere>(Point3{0, -1000, 0}, 1000.0, checkered(0.32)));
    scene.add(std::make_shared<Sphere>(Point3{0, 1, 0}, 1.0, std::move(ball)));
    return scene;
}

Camera ball_on_checker_camera() { return {.look_from = {6, 2, 6}, .look_at = {0, 1, 0}, .vertical_fov = 20}; }

Scene cornell_room(std::shared_ptr<const Hittable> light) {
    const auto red = matte({.65, .05, .05}), white = matte({.73, .73, .73}), green = matte({.12, .45, .15});
    const Vec3 x{555, 0, 0}, y{0, 555, 0}, z{0, 0, 555};
    Scene scene;
    scene.add(std::make_shared<Quad>(Point3{555, 0, 0}, y, z, green));
    scene.add(std::make_shared<Quad>(Point3{0, 0, 0}, y, z, red));
    scene.add(std::make_shared<Quad>(Point3{0, 0, 0}, x, z, white));    // floor
    scene.add(std::make_shared<Quad>(Point3{0, 555, 0}, x, z, white));  // ceiling
    scene.add(std::make_shared<Quad>(Point3{0, 0, 555}, x, y, white));  // back
    scene.add(std::move(light));
    return scene;
}

Camera cornell_camera() { return {.look_from = {278, 278, -800}, .look_at = {278, 278, 0}, .vertical_fov = 40}; }

std::shared_ptr<const Hittable> tall_box(const std::shared_ptr<const Material>& material) {
    return std::make_shared<Instance>(make_box({0, 0, 0}, {165, 330, 165}, material),
                                      Transform::translate({265, 0, 295}) * Transform::rotate_y(15));
}

std::shared_ptr<const Hittable> short_box(const std::shared_ptr<const Material>& material) {
    return std::make_shared<Instance>(make_box({0, 0, 0}, {165, 165, 165}, material),
                                      Transform::translate({130, 0, 65}) * Transform::rotate_y(-18));
}

}  // namespace limn::figures
