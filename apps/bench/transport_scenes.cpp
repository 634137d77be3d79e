#include "bench/transport_scenes.h"

#include <array>
#include <functional>
#include <numbers>

#include "bench/material_scenes.h"
#include "bench/random.h"
#include "figures.h"
#include "gallery.h"
#include "limn/limn.h"
#include "scene_parts.h"

namespace limn::bench {

namespace {

using figures::matte;

std::shared_ptr<const Material> glass() { return std::make_shared<Dielectric>(1.5, Fresnel::exact); }

Figure cornell_empty() {
    return {.name = {},
            .scene = figures::cornell_room(figures::cornell_lamp()),
            .camera = figures::cornell_camera(),
            .settings = {}};
}

Figure lamps_on_grey() {
    Figure figure = figures::fig12_emissive();
    figure.scene = figures::stone_under_lamps(matte({.5, .5, .5}));
    return figure;
}

Figure with_mirror(Figure figure) {
    figure.scene = figures::three_balls(glass(), std::make_shared<Metal>(Color{.8, .6, .2}, 0));
    return figure;
}

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

// Hung into the empty box.
Figure ball_in_room(std::shared_ptr<const Material> material) {
    Figure figure = cornell_empty();
    figure.scene.add(hilly_ball({278, 200, 278}, 150, std::move(material)));
    return figure;
}

// Square leaves of light, turned any way, in the upper half of the room.
Figure many_lights() {
    constexpr std::uint64_t kCount = 200;
    constexpr double kSide = 6;
    auto lamps = std::make_shared<HittableList>();
    for (std::uint64_t i = 0; i < kCount; ++i) {
        const auto u = [i](std::uint64_t dimension) { return random_number(8, i, dimension); };
        const Frame turned{Normal3(sample_uniform_sphere(u(0), u(1)))};
        const Point3 corner{40 + 475 * u(2), 280 + 255 * u(3), 40 + 475 * u(4)};
        const Color color{5 + 25 * u(5), 5 + 25 * u(6), 5 + 25 * u(7)};
        lamps->add(std::make_shared<Quad>(corner, turned.to_world({kSide, 0, 0}), turned.to_world({0, kSide, 0}),
                                          std::make_shared<DiffuseLight>(color)));
    }
    Figure figure = cornell_empty();
    figure.scene = figures::cornell_room(lamps);
    figure.scene.add(figures::tall_box(matte({.73, .73, .73})));
    figure.scene.add(figures::short_box(matte({.73, .73, .73})));
    return figure;
}

constexpr std::ptrdiff_t kPromised = 10;  // of the entries, the first

struct Entry {
    std::string name;
    std::function<Figure()> make;
};

const std::vector<Entry>& entries() {
    static const std::vector<Entry> all{
        {"cornell-empty", cornell_empty},
        {"cornell", [] { return figures::fig15_cornell_box(); }},
        {"lamps", lamps_on_grey},
        {"three-spheres", [] { return with_mirror(figures::fig13_dielectric()); }},
        {"depth-of-field", [] { return with_mirror(figures::fig18_with_dof()); }},
        {"still-spheres", still_spheres},
        {"smoke", [] { return figures::fig16_volume_cornell_box(); }},
        {"mesh",
         [] {
             return ball_in_room(matte({.73, .73, .73}));
         }},
        {"glass-mesh", [] { return ball_in_room(glass()); }},
        {"many-lights", many_lights},
        {"rough-copper", rough_copper},
        {"rough-glass", rough_glass},
        {"still-life", still_life},
        {"window", gallery::sunlit_room},
    };
    return all;
}

}  // namespace

const std::vector<std::string>& transport_scene_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const Entry& entry : entries()) all.push_back(entry.name);
        return all;
    }();
    return names;
}

const std::vector<std::string>& promised_scene_names() {
    static const std::vector<std::string> names(transport_scene_names().begin(),
                                                transport_scene_names().begin() + kPromised);
    return names;
}

Figure make_transport_scene(const std::string& name) {
    for (const Entry& entry : entries()) {
        if (entry.name != name) continue;
        Figure figure = entry.make();
        figure.name = name;
        return figure;
    }
    throw ArgumentError("'" + name + "' is not the name of a scene");
}

}  // namespace limn::bench
