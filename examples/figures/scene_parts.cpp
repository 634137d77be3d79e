#include "scene_parts.h"

namespace limn::figures {

namespace {

// Returns the material of a sphere. `fresnel` is used for glass.
std::shared_ptr<const Material> material_of(const BouncingSphere& sphere, Fresnel fresnel) {
    if (sphere.material == "metal") return std::make_shared<Metal>(sphere.color, sphere.parameter);
    if (sphere.material == "dielectric") return std::make_shared<Dielectric>(sphere.parameter, fresnel);
    return matte(sphere.color);
}

}  // namespace

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

Scene balls_on_checker(const std::vector<BouncingSphere>& balls, Fresnel fresnel) {
    Scene scene;
    scene.background = kSecondBookSky;
    scene.add(std::make_shared<Sphere>(Point3{0, -1000, 0}, 1000.0, checkered(0.32)));
    for (const BouncingSphere& s : balls)
        scene.add(std::make_shared<Sphere>(s.center0, s.center1, s.radius, material_of(s, fresnel)));
    return scene;
}

Scene stone_under_lamps(const std::shared_ptr<const Material>& stone) {
    const auto light = std::make_shared<DiffuseLight>(Color{4, 4, 4});
    Scene scene;
    scene.add(std::make_shared<Sphere>(Point3{0, -1000, 0}, 1000.0, stone));
    scene.add(std::make_shared<Sphere>(Point3{0, 2, 0}, 2.0, stone));
    scene.add(std::make_shared<Sphere>(Point3{0, 7, 0}, 2.0, light));
    scene.add(std::make_shared<Quad>(Point3{3, 1, -2}, Vec3{2, 0, 0}, Vec3{0, 2, 0}, light));
    return scene;
}

Scene three_balls(const std::shared_ptr<const Material>& glass, std::shared_ptr<const Material> metal) {
    Scene scene;
    scene.background = kFirstBookSky;
    scene.add(std::make_shared<Sphere>(Point3{0, -100.5, -1}, 100.0, matte({.8, .8, 0})));
    scene.add(std::make_shared<Sphere>(Point3{0, 0, -1}, .5, matte({.1, .2, .5})));
    scene.add(std::make_shared<Sphere>(Point3{-1, 0, -1}, .5, glass));
    // Add the bubble. Its negative radius turns its normals inward.
    scene.add(std::make_shared<Sphere>(Point3{-1, 0, -1}, -.4, glass));
    scene.add(std::make_shared<Sphere>(Point3{1, 0, -1}, .5, std::move(metal)));
    return scene;
}

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

std::shared_ptr<const Hittable> cornell_lamp() {
    return std::make_shared<Quad>(Point3{343, 554, 332}, Vec3{-130, 0, 0}, Vec3{0, 0, -105},
                                  std::make_shared<DiffuseLight>(Color{15, 15, 15}));
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
