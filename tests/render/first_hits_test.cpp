// What the camera meets first, against closed forms.
#include "limn/render/first_hits.h"

#include "catch.h"
#include "limn/math/error.h"
#include "limn/scene/material/alpha_mask.h"
#include "limn/scene/material/dielectric.h"
#include "limn/scene/material/metal.h"
#include "limn/scene/material/normal_map.h"
#include "limn/scene/texture/solid.h"
#include "support/pictures.h"

namespace limn::first_hits_test {

using namespace test;

namespace {

constexpr int kSide = 20;

std::size_t at(int x, int y) { return static_cast<std::size_t>(kSide * y + x); }
Vec3 vec(const Color& c) { return {c.r, c.g, c.b}; }

}  // namespace

TEST_CASE("First hits: of a sphere on a plane, position, depth, normal and albedo as trigonometry has them",
          "[render][channels]") {
    const Color red{0.7, 0.2, 0.1};
    const CompiledScene scene =
        compile_with(sky(1), {floor_of(grey(0.5)), sphere({0, 1, 0}, 1, std::make_shared<Lambertian>(red))});
    const Camera camera = camera_at({0, 3, 6}, {0, 1, 0}, 50);
    RenderSettings settings = square(kSide, 1, 1);
    settings.antialias = false;  // so that the means are of one ray
    const FirstHits hits = first_hits(scene, camera, settings);
    const CameraRays rays(camera, kSide, kSide);
    int of_sphere = 0, of_floor = 0, of_nothing = 0;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const Ray ray = rays.ray(x + 0.5, y + 0.5, 0.5, 0.5, 0.5);
            const Vec3 d = normalize(ray.direction), from = ray.origin - Point3{0, 1, 0};
            const double b = dot(d, from), root = b * b - dot(from, from) + 1;
            const bool is_sphere = root > 0;
            const double distance = is_sphere ? -b - std::sqrt(root) : -ray.origin.y / d.y;
            const Point3 p = ray.origin + distance * d;
            if (!is_sphere && (d.y >= 0 || std::abs(p.x) > 50 || std::abs(p.z) > 50)) {
                ++of_nothing;
                CHECK(hits.depth[at(x, y)] == std::numeric_limits<float>::infinity());
                CHECK(hits.object[at(x, y)] == -1);
                CHECK(hits.primitive[at(x, y)] == -1);
                CHECK(hits.albedo.at(x, y) == Color{});
                CHECK(hits.normal.at(x, y) == Color{});
                CHECK(hits.position.at(x, y) == Color{});
                continue;
            }
            ++(is_sphere ? of_sphere : of_floor);
            const Vec3 normal = is_sphere ? p - Point3{0, 1, 0} : Vec3{0, 1, 0};
            CHECK(static_cast<double>(hits.depth[at(x, y)]) == Approx(distance).epsilon(1e-6));
            CHECK(length(vec(hits.position.at(x, y)) - (p - Point3{})) <= 1e-6 * distance);
            CHECK(length(vec(hits.normal.at(x, y)) - normal) <= 2e-6);
            CHECK(length(vec(hits.albedo.at(x, y)) - vec(is_sphere ? red : Color{0.5, 0.5, 0.5})) <= 1e-7);
            CHECK(hits.object[at(x, y)] == (is_sphere ? 1 : 0));
            CHECK(hits.primitive[at(x, y)] == 0);
        }
    CHECK(of_sphere > 20);
    CHECK(of_floor > 20);
    CHECK(of_nothing > 20);
}

TEST_CASE("First hits: albedo and normal cover edges as the picture does, and a plane has no noise",
          "[render][channels]") {
    const Camera camera{
        .look_from = {0, 0, 4}, .look_at = {0, 0, 0}, .projection = Projection::orthographic, .view_height = kSide};
    const CompiledScene scene = compile_with(
        sky(1), {quad({-99, -99, 0}, {99.25, 0, 0}, {0, 198, 0}, std::make_shared<Lambertian>(Color{0.8, 0.4, 0.2}))});
    const FirstHits hits = first_hits(scene, camera, square(kSide, 1, 1));
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide / 2; ++x) {
            CHECK(length(vec(hits.albedo.at(x, y)) - Vec3{0.8, 0.4, 0.2}) <= 1e-7);
            CHECK(hits.normal.at(x, y) == Color{0, 0, 1});
        }
        // A quarter of sixteen even points.
        CHECK(hits.albedo.at(kSide / 2, y).r == Approx(0.2).margin(1e-6));
        CHECK(hits.normal.at(kSide / 2, y).b == 0.25);
    }
}

TEST_CASE("First hits: glass is white, a lamp black, a metal its colour, and what does not bend light is not there",
          "[render][channels]") {
    const Camera camera = camera_at({0, 0, 10}, {0, 0, 0}, 5);
    const auto albedo_of = [&](const std::vector<Object>& objects) {
        RenderSettings settings = square(1, 1, 1);
        return first_hits(compile_with(sky(1), objects), camera, settings).albedo.at(0, 0);
    };
    CHECK(albedo_of({sphere({0, 0, 0}, 3, std::make_shared<Dielectric>(1.5))}) == Color{1, 1, 1});
    CHECK(albedo_of({sphere({0, 0, 0}, 3, lamp(4))}) == Color{});
    const Color gold{0.75, 0.5, 0.25};
    CHECK(albedo_of({sphere({0, 0, 0}, 3, std::make_shared<Metal>(gold, 0))}) == gold);
    const Object fog = std::make_shared<ConstantMedium>(sphere({0, 0, 5}, 2, grey(1)), 5, Color{1, 1, 1});
    CHECK(albedo_of({fog, sphere({0, 0, 0}, 3, std::make_shared<Metal>(gold, 0))}) == gold);
}

TEST_CASE("First hits: holes are looked through where they pass most light, normals and albedo are of a normal map",
          "[render][channels]") {
    const Camera camera = camera_at({0, 0, 10}, {0, 0, 0}, 5);
    const auto upright = [](double z, const std::shared_ptr<const Material>& material) {
        return quad({-4, -4, z}, {8, 0, 0}, {0, 8, 0}, material);
    };
    const auto screen = [&](double z, double opacity) {
        return upright(z, std::make_shared<AlphaMask>(grey(0.25), opacity));
    };
    const Vec3 leaning = normalize(Vec3{1, 2, 4});
    const auto bumps =
        std::make_shared<SolidColor>(Color{(leaning.x + 1) / 2, (leaning.y + 1) / 2, (leaning.z + 1) / 2});
    const Object wall = upright(0, std::make_shared<NormalMap>(grey(0.75), bumps));
    const auto depth = [&](const std::vector<Object>& objects) {
        return first_hits(compile_with(sky(1), objects), camera, square(1, 1, 1)).depth[0];
    };
    CHECK(depth({wall, screen(1, 0.6), screen(2, 0.4)}) == 9);
    CHECK(depth({wall, screen(1, 0.3), screen(2, 0.4)}) == 9);  // 0.58 are stopped
    CHECK(depth({wall, screen(1, 0.1), screen(2, 0.4)}) == 10);
    CHECK(depth({screen(1, 0)}) == std::numeric_limits<float>::infinity());
    const FirstHits hits = first_hits(compile_with(sky(1), {wall, screen(1, 0.2)}), camera, square(1, 1, 1));
    CHECK(length(vec(hits.normal.at(0, 0)) - leaning) <= 1e-6);
    CHECK(hits.albedo.at(0, 0).g == Approx(0.75));
}

TEST_CASE("First hits: those of a crop are those of the whole picture", "[render][channels]") {
    const CompiledScene scene = compile_with(sky(1), {floor_of(grey(0.5)), sphere({0, 1, 0}, 1, grey(0.8))});
    const Camera camera = camera_at({0, 3, 6}, {0, 1, 0}, 50);
    RenderSettings part = square(kSide, 1, 1);
    part.crop = PixelBounds{4, 7, 15, 12};
    const FirstHits whole = first_hits(scene, camera, square(kSide, 1, 1)), some = first_hits(scene, camera, part);
    REQUIRE(some.albedo.width() == 11);
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 11; ++x) {
            CHECK(some.albedo.at(x, y) == whole.albedo.at(x + 4, y + 7));
            CHECK(some.normal.at(x, y) == whole.normal.at(x + 4, y + 7));
            CHECK(some.depth[static_cast<std::size_t>(11 * y + x)] == whole.depth[at(x + 4, y + 7)]);
        }
}

TEST_CASE("First hits: as channels of a file they have names and one value a pixel", "[render][channels]") {
    const CompiledScene scene = compile_with(sky(1), {sphere({0, 0, 0}, 1, grey(0.5))});
    const FirstHits hits = first_hits(scene, camera_at({0, 0, 9}, {0, 0, 0}, 5), square(3, 1, 1));
    const auto names = [&](const char* name) {
        std::vector<std::string> all;
        for (const ImageLayer& layer : hits.layers(name)) {
            CHECK(layer.values.size() == 9);
            all.push_back(layer.name);
        }
        return all;
    };
    using Names = std::vector<std::string>;
    CHECK(names("albedo") == Names{"albedo.R", "albedo.G", "albedo.B"});
    CHECK(names("normal") == Names{"normal.X", "normal.Y", "normal.Z"});
    CHECK(names("position") == Names{"position.X", "position.Y", "position.Z"});
    for (const char* name : {"depth", "object", "primitive"}) CHECK(names(name) == Names{name});
    CHECK(hits.layers("depth")[0].values[4] == Approx(8));
    CHECK_FALSE(FirstHits::knows("error"));
    CHECK_THROWS_AS(hits.layers("error"), ArgumentError);
}

TEST_CASE("Compiled scene: a surface tells its albedo, its emission and what the model calls its material",
          "[render][channels]") {
    MeshData data;
    data.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {3, 0, 0}, {2, 1, 0}, {4, 0, 0}, {5, 0, 0}, {4, 1, 0}};
    data.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
    data.material_slots = {2, 0, 1};
    const auto red = std::make_shared<Lambertian>(Color{0.75, 0.25, 0.125});
    Model model;
    model.materials = {"lamp", "paint"};
    model.meshes = {std::make_shared<Mesh>(data, std::vector<MaterialPtr>{grey(0.5), lamp(3), grey(0.1)})};
    model.instances = {{0, {}, ""}, {0, Transform::translate({0, 9, 0}), ""}};
    model.replace_material("paint", red);
    Scene described;
    described.add(sphere({0, -9, 0}, 1, grey(0.5)));
    described.add(model);
    const CompiledScene scene = compile(described);
    const auto check = [&](double x, double y, const char* name, const Color& albedo, const Color& emission) {
        const Ray ray{.origin = {x, y, 5}, .direction = {0, 0, -1}};
        const std::optional<RayHit> hit = scene.closest_hit(ray);
        REQUIRE(hit);
        const Surface surface = scene.surface_at(ray, *hit);
        CHECK(scene.material_name(*hit) == name);
        CHECK(length(vec(scene.albedo(surface)) - vec(albedo)) <= 1e-15);
        CHECK(scene.emission(surface) == emission);
    };
    for (const double up : {0.25, 9.25}) {
        check(0.25, up, "paint", {0.75, 0.25, 0.125}, {});
        check(2.25, up, "", {0.5, 0.5, 0.5}, {});
        check(4.25, up, "lamp", {}, {3, 3, 3});
    }
    check(0, -9, "", {0.5, 0.5, 0.5}, {});
}

}  // namespace limn::first_hits_test
