#include "bench/transport_scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "bench/scenes.h"
#include "figures.h"
#include "gallery.h"
#include "limn/limn.h"
#include "parts.h"
#include "scene_parts.h"

namespace limn::bench {
namespace {

using figures::matte;

const Color kLightGrey{.73, .73, .73};

std::shared_ptr<const Material> glass() { return std::make_shared<Dielectric>(1.5, Fresnel::exact); }

Figure figure_of(Scene scene, const Camera& camera) {
    return {.name = {}, .scene = std::move(scene), .camera = camera, .settings = {}};
}

Figure cornell_empty() { return figure_of(figures::cornell_room(figures::cornell_lamp()), figures::cornell_camera()); }

// Returns figure 12 with a grey material instead of marble.
Figure lamps() {
    Figure figure = figures::fig12_emissive();
    figure.scene = figures::stone_under_lamps(matte({.5, .5, .5}));
    return figure;
}

// Returns the figure with another scene of three balls: the glass reflects by Fresnel's equations, and the metal is a
// smooth mirror.
Figure with_mirror(Figure figure) {
    figure.scene = figures::three_balls(glass(), std::make_shared<Metal>(Color{.8, .6, .2}, 0));
    return figure;
}

// Returns figure 1 without motion and with smooth metal. Its glass reflects by Fresnel's equations.
Figure still_spheres() {
    auto balls = figures::read_bouncing_spheres(figures::data_file("bounce_spheres.csv"));
    for (figures::BouncingSphere& ball : balls) {
        ball.center1 = ball.center0;
        if (ball.material == "metal") ball.parameter = 0;
    }
    Figure figure = figures::fig01_bouncing_spheres();
    figure.scene = figures::balls_on_checker(balls, Fresnel::exact);
    return figure;
}

// Returns a ball with hills: a mesh of 69312 triangles.
std::shared_ptr<const Mesh> hilly_ball(const Point3& center, double radius, std::shared_ptr<const Material> material) {
    MeshData data = make_scene("sphere", 0.035).mesh->data();
    for (Float3& v : data.vertices) v = to_float3(center + radius * Vec3{v.x, v.y, v.z});
    return std::make_shared<Mesh>(std::move(data), std::move(material));
}

Figure ball_in_room(std::shared_ptr<const Material> material) {
    Figure figure = cornell_empty();
    figure.scene.add(hilly_ball({278, 200, 278}, 150, std::move(material)));
    return figure;
}

// Returns the Cornell box with 200 small square lamps of random orientation in its upper half.
Figure many_lights() {
    constexpr std::uint64_t kCount = 200;
    constexpr double kSide = 6;
    auto lamps = std::make_shared<HittableList>();
    for (std::uint64_t i = 0; i < kCount; ++i) {
        const auto u = random_numbers(8, i);
        const Frame turned{Normal3(sample_uniform_sphere(u(0), u(1)))};
        const Point3 corner{40 + 475 * u(2), 280 + 255 * u(3), 40 + 475 * u(4)};
        const Color color{5 + 25 * u(5), 5 + 25 * u(6), 5 + 25 * u(7)};
        lamps->add(std::make_shared<Quad>(corner, turned.to_world({kSide, 0, 0}), turned.to_world({0, kSide, 0}),
                                          std::make_shared<DiffuseLight>(color)));
    }
    Scene scene = figures::cornell_room(lamps);
    scene.add(figures::tall_box(matte(kLightGrey)));
    scene.add(figures::short_box(matte(kLightGrey)));
    return figure_of(std::move(scene), figures::cornell_camera());
}

// Returns the map of a sky that includes the sun. The sun covers the pixels within two degrees of its direction and has
// the irradiance of the SunLight.
EnvironmentMap sky_with_sun() {
    const SkySettings settings;
    const Sky sky = make_sky(settings);
    Image map = *sky.environment->image();
    const double row = std::numbers::pi / map.height(), column = 2 * std::numbers::pi / map.width();
    std::vector<std::pair<int, int>> disc;
    double solid_angle = 0;
    for (int y = 0; y < map.height(); ++y) {
        for (int x = 0; x < map.width(); ++x) {
            const double theta = row * (y + 0.5), phi = column * (x + 0.5);
            const Vec3 direction{-std::sin(phi) * std::sin(theta), std::cos(theta), std::cos(phi) * std::sin(theta)};
            if (dot(direction, normalize(settings.to_sun)) <= std::cos(radians(2))) continue;
            disc.emplace_back(x, y);
            solid_angle += (std::cos(row * y) - std::cos(row * (y + 1))) * column;
        }
    }
    const Color radiance = sky.sun.irradiance / (solid_angle * sky.environment->scale());
    for (const auto& [x, y] : disc) map.set(x, y, map.at(x, y) + radiance);
    return EnvironmentMap(std::move(map), {}, sky.environment->scale());
}

Figure rough_copper() {
    Scene scene;
    scene.add(std::make_shared<Quad>(Point3{-20, -1, -20}, Vec3{0, 0, 40}, Vec3{40, 0, 0}, matte({.4, .4, .4})));
    scene.add(hilly_ball({0, 0, 0}, 1, std::make_shared<RoughConductor>(gallery::kCopper, 0.2)));
    scene.environment = std::make_shared<EnvironmentMap>(sky_with_sun());
    return figure_of(std::move(scene), {.look_from = {0, 1.5, 5}, .look_at = {0, -.1, 0}, .vertical_fov = 30});
}

Figure rough_glass() {
    Figure figure = cornell_empty();
    figure.scene.add(figures::tall_box(matte(kLightGrey)));
    figure.scene.add(std::make_shared<Sphere>(Point3{190, 110, 170}, 100, std::make_shared<RoughDielectric>(1.5, 0.5)));
    return figure;
}

// Returns the gallery's glTF model. The model has normal maps, alpha and rough metal.
Figure still_life() {
    const Model model = gallery::load("still_life.glb");
    Scene scene;
    scene.add(model);
    scene.background = Background::constant({.05, .06, .08});
    return figure_of(std::move(scene), model.cameras.front().camera);
}

// Returns a floor with a small bright lamp. A screen shadows the floor, which the lamp lights only by way of a fuzzy
// mirror. Samples that find the lamp through the mirror are rare and bright.
Figure fireflies() {
    Scene scene;
    scene.background = Background::constant({.05, .06, .08});
    scene.add(std::make_shared<Quad>(Point3{-4, 0, -4}, Vec3{0, 0, 8}, Vec3{8, 0, 0}, matte({.6, .6, .6})));
    scene.add(std::make_shared<Quad>(Point3{-4, 0, -2}, Vec3{8, 0, 0}, Vec3{0, 4, 0},
                                     std::make_shared<Metal>(Color{.9, .9, .9}, .15)));
    scene.add(std::make_shared<Sphere>(Point3{0, 1.5, 2}, .05, std::make_shared<DiffuseLight>(Color{800, 700, 600})));
    scene.add(std::make_shared<Quad>(Point3{-1, 1.2, 1}, Vec3{2, 0, 0}, Vec3{0, 0, 2}, matte({.6, .6, .6})));
    return figure_of(std::move(scene), {.look_from = {0, 3, 6}, .look_at = {0, .8, -1}, .vertical_fov = 45});
}

// All scenes by name. The first fourteen can be rendered by limn's peers.
constexpr std::pair<const char*, Figure (*)()> kScenes[] = {
    {"cornell-empty", cornell_empty},
    {"cornell", [] { return figures::fig15_cornell_box(); }},
    {"lamps", lamps},
    {"three-spheres", [] { return with_mirror(figures::fig13_dielectric()); }},
    {"depth-of-field", [] { return with_mirror(figures::fig18_with_dof()); }},
    {"still-spheres", still_spheres},
    {"smoke", [] { return figures::fig16_volume_cornell_box(); }},
    {"mesh", [] { return ball_in_room(matte(kLightGrey)); }},
    {"glass-mesh", [] { return ball_in_room(glass()); }},
    {"many-lights", many_lights},
    {"rough-copper", rough_copper},
    {"rough-glass", rough_glass},
    {"still-life", still_life},
    {"window", gallery::sunlit_room},
    {"bouncing", [] { return figures::fig01_bouncing_spheres(); }},
    {"glass", [] { return figures::fig13_dielectric(); }},
    {"fireflies", fireflies},
};

}  // namespace

std::vector<std::string> transport_scene_names() {
    std::vector<std::string> names;
    for (const auto& [name, make] : kScenes) names.emplace_back(name);
    return names;
}

Figure make_transport_scene(const std::string& name) {
    const auto* found = std::ranges::find(kScenes, name, [](const auto& scene) { return scene.first; });
    std::string known;
    for (const auto& [other, make] : kScenes) known += std::string(" ") + other;
    if (found == std::end(kScenes)) throw ArgumentError("'" + name + "' is not the name of a scene; there are" + known);
    Figure figure = found->second();
    figure.name = name;
    return figure;
}

}  // namespace limn::bench
