#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>

#include "bench/describe_scene.h"
#include "bench/transport_scenes.h"
#include "catch.h"
#include "figures.h"
#include "gallery.h"
#include "limn/core/error.h"
#include "limn/query/compiled_scene.h"

using namespace limn;
using Json = nlohmann::json;

namespace {

// What the peers read.
Json description(const Figure& figure) { return Json::parse(app::json_text(bench::describe_scene(figure))); }

std::size_t count_primitives(const Json& shapes) {
    std::size_t count = shapes["spheres"].size() + shapes["quads"].size();
    for (const Json& mesh : shapes["meshes"]) count += mesh["triangles"].size();
    for (const Json& medium : shapes["media"]) count += count_primitives(medium["boundary"]);
    return count;
}

Vec3 vec(const Json& j) { return {j[0], j[1], j[2]}; }

void grow(Box& box, const Json& shapes) {
    for (const Json& s : shapes["spheres"]) {
        const double r = std::abs(s["radius"].get<double>());
        const Point3 center = Point3{} + vec(s["center"]);
        box = merge(box, Box{center - Vec3{r, r, r}, center + Vec3{r, r, r}});
    }
    for (const Json& q : shapes["quads"])
        for (const double u : {0.0, 1.0})
            for (const double v : {0.0, 1.0}) {
                const Point3 corner = Point3{} + vec(q["corner"]) + u * vec(q["edge_u"]) + v * vec(q["edge_v"]);
                box = merge(box, Box{corner, corner});
            }
    for (const Json& mesh : shapes["meshes"])
        for (const Json& v : mesh["vertices"]) box = merge(box, Box{Point3{} + vec(v), Point3{} + vec(v)});
    for (const Json& medium : shapes["media"]) grow(box, medium["boundary"]);
}

double largest_difference(const Point3& a, const Point3& b) {
    return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

}  // namespace

TEST_CASE("Transport: the peers are told of every primitive that limn compiles", "[bench][transport]") {
    for (const std::string& name : bench::transport_scene_names()) {
        CAPTURE(name);
        const Figure figure = bench::make_transport_scene(name);
        const Json told = description(figure);
        CHECK(count_primitives(told) == compile(figure.scene).stats().primitives);
        CHECK(told["name"] == name);
        CHECK(told["max_depth"] == figure.settings.max_depth);
    }
}

TEST_CASE("Transport: what the peers are told stands where limn has it", "[bench][transport]") {
    for (const std::string& name : bench::transport_scene_names()) {
        CAPTURE(name);
        const Figure figure = bench::make_transport_scene(name);
        Box told;
        grow(told, description(figure));
        const Box real = figure.scene.bounds();  // rounded outward
        CHECK(largest_difference(told.lower, real.lower) < 1e-9);
        CHECK(largest_difference(told.upper, real.upper) < 1e-9);
    }
}

TEST_CASE("Transport: materials, media, sky and lens are told as they are", "[bench][transport]") {
    const auto told = [](const char* name) { return description(bench::make_transport_scene(name)); };
    const Json balls = told("depth-of-field");
    CHECK(balls["spheres"][3]["radius"] == -.4);
    CHECK(balls["spheres"][3]["material"] == Json{{"kind", "glass"}, {"index", 1.5}});
    CHECK(balls["spheres"][4]["material"] == Json{{"kind", "mirror"}, {"color", {.8, .6, .2}}});
    CHECK(balls["background"] == Json{{"bottom", {1., 1., 1.}}, {"top", {.5, .7, 1.}}});
    CHECK(std::abs(balls["camera"]["lens_radius"].get<double>() - 3.4 * std::tan(5 * std::numbers::pi / 180)) < 1e-12);

    const Json smoke = told("smoke");
    CHECK(smoke["media"].size() == 2);
    CHECK(smoke["media"][0]["albedo"] == Json{0., 0., 0.});
    CHECK(smoke["media"][1]["density"] == .01);
    CHECK(told("still-spheres")["spheres"][0]["material"]["color"] ==
          Json{{"cell", .32}, {"even", {.2, .3, .1}}, {"odd", {.9, .9, .9}}});
    const Json copper = told("rough-copper");
    CHECK(copper["meshes"][0]["material"]["kind"] == "rough-conductor");
    CHECK(copper["meshes"][0]["material"]["alpha"].get<double>() == Approx(.04));
    CHECK(copper["meshes"][0]["material"]["eta"][0].get<double>() == Approx(.21));
    CHECK(copper["meshes"][0]["material"]["k"][0].get<double>() == Approx(3.67));
    const std::size_t pixels =
        copper["environment"]["width"].get<std::size_t>() * copper["environment"]["height"].get<std::size_t>();
    CHECK(copper["environment"]["values"].size() == 3 * pixels);
    CHECK(told("rough-glass")["spheres"][0]["material"] ==
          Json{{"kind", "rough-glass"}, {"index", 1.5}, {"alpha", .25}});
    const Json room = told("window");
    CHECK(room["suns"][0]["angular_radius"] == SunLight{}.angular_radius);
    CHECK(room["meshes"][0]["normals"].size() == room["meshes"][0]["vertices"].size());
    CHECK(told("cornell")["quads"][5]["material"] == Json{{"kind", "light"}, {"color", {15., 15., 15.}}});
}

TEST_CASE("Transport: what the peers have no word for is refused", "[bench][transport]") {
    for (const auto& make : std::vector<std::function<Figure()>>{
             [] { return figures::fig01_bouncing_spheres(); },  // motion, Schlick's approximation
             [] { return figures::fig11_metal(); },             // fuzz
             [] { return figures::fig12_emissive(); },          // noise
             [] { return gallery::copper_knot(); },             // plastic
             [] { return figures::fig09_checkered_triangle(); }})
        CHECK_THROWS_AS(bench::describe_scene(make()), Error);
    CHECK_THROWS_AS(bench::make_transport_scene("nowhere"), ArgumentError);
}
