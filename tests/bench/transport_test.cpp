#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "bench/transport_scenes.h"
#include "catch.h"
#include "figures.h"
#include "gallery.h"
#include "json_output.h"
#include "limn/limn.h"

using namespace limn;
using Json = nlohmann::json;

namespace {

// What the peers read.
Json description(const Figure& figure) { return Json::parse(app::json_text(bench::describe_scene(figure))); }

Json described(const char* name) { return description(bench::make_transport_scene(name)); }

Point3 point(const Json& j) { return {j[0], j[1], j[2]}; }

// The shapes of a description, in limn's terms.
void add_shapes(Scene& scene, const Json& told) {
    for (const Json& s : told["spheres"])
        scene.add(std::make_shared<Sphere>(point(s["center"]), s["radius"].get<double>(), nullptr));
    for (const Json& m : told["meshes"]) {
        MeshData data;
        for (const Json& v : m["vertices"]) data.vertices.push_back({v[0], v[1], v[2]});
        for (const Json& t : m["triangles"]) data.triangles.push_back({t[0], t[1], t[2]});
        scene.add(std::make_shared<Mesh>(std::move(data), nullptr));
    }
    for (const Json& m : told["media"]) add_shapes(scene, m["boundary"]);
}

// Those that no peer can express.
bool is_of_limn(const std::string& name) { return name == "bouncing" || name == "glass" || name == "fireflies"; }

}  // namespace

TEST_CASE("Transport: what the peers are told is where limn has it", "[bench][transport]") {
    for (const std::string& name : bench::transport_scene_names()) {
        if (is_of_limn(name)) continue;
        CAPTURE(name);
        const Figure figure = bench::make_transport_scene(name);
        const Json told = description(figure);
        CHECK(told["max_depth"] == figure.settings.max_depth);
        Scene copy;
        add_shapes(copy, told);
        const CompiledScene ours = compile(figure.scene), theirs = compile(copy);
        const Box box = figure.scene.bounds();
        std::mt19937_64 random(1);
        const auto inside = [&] {
            std::uniform_real_distribution<double> u;
            const Vec3 d = box.diagonal();
            return box.lower + Vec3{u(random) * d.x, u(random) * d.y, u(random) * d.z};
        };
        for (int i = 0; i < 1000; ++i) {
            const Point3 origin = inside();
            const Ray ray{.origin = origin, .direction = inside() - origin};
            const auto a = ours.closest_hit(ray), b = theirs.closest_hit(ray);
            REQUIRE(a.has_value() == b.has_value());
            if (a) CHECK(b->t == Approx(a->t).margin(1e-4));  // vertices of meshes are floats
        }
    }
}

TEST_CASE("Transport: materials, media, sky and lens are told as they are", "[bench][transport]") {
    const Json balls = described("depth-of-field");
    CHECK(balls["spheres"][3]["radius"] == -.4);
    CHECK(balls["spheres"][3]["material"] == Json{{"kind", "glass"}, {"index", 1.5}});
    CHECK(balls["spheres"][4]["material"] == Json{{"kind", "mirror"}, {"color", {.8, .6, .2}}});
    CHECK(balls["background"] == Json{{"bottom", {1., 1., 1.}}, {"top", {.5, .7, 1.}}});
    CHECK(std::abs(balls["camera"]["lens_radius"].get<double>() - 3.4 * std::tan(5 * std::numbers::pi / 180)) < 1e-12);

    const Json smoke = described("smoke");
    CHECK(smoke["media"].size() == 2);
    CHECK(smoke["media"][0]["albedo"] == Json{0., 0., 0.});
    CHECK(smoke["media"][1]["density"] == .01);
    CHECK(described("still-spheres")["spheres"][0]["material"]["color"] ==
          Json{{"cell", .32}, {"even", {.2, .3, .1}}, {"odd", {.9, .9, .9}}});
    const Json copper = described("rough-copper");
    CHECK(copper["meshes"][1]["material"]["kind"] == "rough-conductor");
    CHECK(copper["meshes"][1]["material"]["alpha"].get<double>() == Approx(.04));
    const std::size_t pixels =
        copper["environment"]["width"].get<std::size_t>() * copper["environment"]["height"].get<std::size_t>();
    CHECK(copper["environment"]["values"].size() == 3 * pixels);
    CHECK(described("rough-glass")["spheres"][0]["material"] ==
          Json{{"kind", "rough-glass"}, {"index", 1.5}, {"alpha", .25}});
    const Json room = described("window");
    CHECK(room["suns"][0]["angular_radius"] == SunLight{}.angular_radius);
    CHECK(room["meshes"].back()["normals"].size() == room["meshes"].back()["vertices"].size());
    const Json lamp = described("cornell-empty")["meshes"].back();
    CHECK(lamp["material"] == Json{{"kind", "light"}, {"color", {15., 15., 15.}}});
    CHECK(lamp["vertices"][1] == Json{213., 554., 332.});
}

TEST_CASE("Transport: what the peers have no word for is refused", "[bench][transport]") {
    for (const auto& make : std::vector<std::function<Figure()>>{
             [] { return bench::make_transport_scene("bouncing"); },   // motion
             [] { return bench::make_transport_scene("glass"); },      // Schlick's approximation
             [] { return bench::make_transport_scene("fireflies"); },  // fuzz
             [] { return figures::fig12_emissive(); },                 // noise
             [] { return gallery::copper_knot(); },                    // plastic
             [] { return figures::fig09_checkered_triangle(); }})
        CHECK_THROWS_AS(bench::describe_scene(make()), Error);
    CHECK_THROWS_AS(bench::make_transport_scene("nowhere"), ArgumentError);
}
