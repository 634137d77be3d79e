#include "gallery.h"
#include "parts.h"

namespace limn::gallery {

Figure glass_of_water() {
    constexpr double kGlass = 1.5, kWater = 1.333, kLevel = 3.1;
    // Define the profiles of the three interfaces: glass to air, glass to water, water to air.
    const ProfilePoint bottom{.95, .42}, corner{1.05, .5}, waterline{1.264, kLevel};
    const auto glass_to = [](double index) { return std::make_shared<Dielectric>(index, Fresnel::exact); };
    const std::vector<ProfilePoint> air_side{{0, 0},       {1.05, 0},   {1.12, .05},  {1.2, .4}, {1.45, 4.3},
                                             {1.43, 4.36}, {1.4, 4.38}, {1.36, 4.35}, waterline};
    const std::vector<ProfilePoint> wet{waterline, corner, bottom, {0, .4}};
    const std::vector<ProfilePoint> surface{waterline, {0, kLevel}};

    // Add the interfaces, each with the ratio of the indices of its two sides, and a straw.
    Figure figure;
    figure.name = __func__;
    Scene& scene = figure.scene;
    constexpr int kSteps = 160;
    scene.add(std::make_shared<Mesh>(lathe(air_side, kSteps), glass_to(kGlass)));
    scene.add(std::make_shared<Mesh>(lathe(wet, kSteps), glass_to(kGlass / kWater)));
    scene.add(std::make_shared<Mesh>(lathe(surface, kSteps), glass_to(kWater)));
    const std::vector<ProfilePoint> straw{{.12, 0}, {.12, 6}, {.1, 6}, {.1, 0}};
    scene.add(std::make_shared<Instance>(
        std::make_shared<Mesh>(lathe(straw, 48), std::make_shared<Plastic>(Color{.8, .05, .04}, 0.25)),
        Transform::translate({-.7, .5, .1}) * Transform::rotate_z(-17)));

    // Add the table cloth.
    const auto cloth = std::make_shared<Checker>(1.2, Color{.75, .72, .66}, Color{.16, .24, .4});
    scene.add(std::make_shared<Disk>(Point3{0, -1e-3, 0}, Vec3{0, 1, 0}, 200, std::make_shared<Lambertian>(cloth)));
    // Add a bright window behind the glass to the left, in a dim room.
    scene.add(std::make_shared<Quad>(Point3{-17, 0, -2}, Vec3{7, 0, -7}, Vec3{0, 11, 0},
                                     std::make_shared<DiffuseLight>(Color{6, 6.2, 6.5})));
    scene.background = Background::gradient({.25, .23, .2}, {.5, .52, .55});
    figure.camera = {.look_from = {1.2, 4.8, 12}, .look_at = {.1, 2.75, 0}, .vertical_fov = 33};
    figure.settings.max_depth = 24;
    return figure;
}

}  // namespace limn::gallery
