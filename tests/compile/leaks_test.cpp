// Rays from inside closed meshes, aimed at vertices and edges: none escapes.
#include "catch.h"
#include "limn/render/compiled_scene.h"
#include "support/scene_zoo.h"
#include "support/tally.h"

using namespace limn;
using namespace limn::test;

namespace {

struct Aim {
    Point3 origin, target;
};

// At a vertex, or at a point of an edge.
Aim random_aim(Random& random, const MeshData& mesh, const Point3& center, bool at_vertex) {
    const Index3 t = mesh.triangles[random.index(mesh.triangles.size())];
    const Point3 a = vertex(mesh, t.a), b = vertex(mesh, t.b);
    return {center + 0.5 * random.unit(), a + (at_vertex ? 0 : random.uniform()) * (b - a)};
}

Tally leaks(const CompiledScene& compiled, const MeshData& mesh, const Point3& center, const Transform& world, int rays,
            std::uint64_t seed) {
    Random random(seed);
    Tally tally;
    for (int i = 0; i < rays; ++i) {
        const Aim aim = random_aim(random, mesh, center, i % 2 == 0);
        const Point3 origin = transform_point(world, aim.origin), target = transform_point(world, aim.target);
        const Ray ray{.origin = origin, .direction = target - origin, .time = random.uniform()};
        const auto hit = compiled.closest_hit(ray);
        ++tally.rays;
        if (!hit || std::abs(hit->t - 1) > 0.05 || !compiled.any_hit(ray)) tally.fault(ray, "leak");
    }
    return tally;
}

}  // namespace

TEST_CASE("Closed meshes: no ray in 1e5 escapes through a vertex or an edge, near or far from the origin",
          "[compile][leaks]") {
    for (const double shift : {0.0, 1e3, 1e5}) {
        const MeshData mesh = icosphere(4, 1, {shift, shift, -shift});
        const CompiledScene compiled = compile(zoo_of("sphere", {std::make_shared<Mesh>(mesh, nullptr)}).scene);
        const Tally tally = leaks(compiled, mesh, {shift, shift, -shift}, Transform{}, 100000, 340);
        INFO("shift " << shift << ": " << tally.first);
        CHECK(tally.wrong == 0);
        CHECK(tally.rays == 100000);
    }
}

TEST_CASE("Closed meshes: vertices snapped to a grid do not leak", "[compile][leaks]") {
    MeshData mesh = icosphere(4);
    for (Float3& p : mesh.vertices) {
        p.x = std::round(p.x * 4096) / 4096;
        p.y = std::round(p.y * 4096) / 4096;
        p.z = std::round(p.z * 4096) / 4096;
    }
    const CompiledScene compiled = compile(zoo_of("snapped", {std::make_shared<Mesh>(mesh, nullptr)}).scene);
    const Tally tally = leaks(compiled, mesh, {0, 0, 0}, Transform{}, 100000, 341);
    INFO(tally.first);
    CHECK(tally.wrong == 0);
}

TEST_CASE("Closed meshes: seen through instances they do not leak either", "[compile][leaks]") {
    const MeshData mesh = icosphere(3);
    const Object object = std::make_shared<Mesh>(mesh, nullptr);
    const Transform m =
        Transform::translate({1e3, -5, 7}) * Transform::rotate({1, 2, 3}, 40) * Transform::scale(0.01, 0.02, 0.03);
    const CompiledScene still = compile(zoo_of("still", {std::make_shared<Instance>(object, m)}).scene);
    const Tally a = leaks(still, mesh, {0, 0, 0}, m, 100000, 342);
    INFO(a.first);
    CHECK(a.wrong == 0);
}

TEST_CASE("A cube: rays along edges, in face planes and through corners hit it in all symmetric copies",
          "[compile][leaks]") {
    const CompiledScene cube = compile(zoo_of("cube", {std::make_shared<Mesh>(cube_mesh(), nullptr)}).scene);
    const CompiledScene sides = compile(zoo_of("sides", {make_box({0, 0, 0}, {1, 1, 1}, nullptr)}).scene);
    const Ray rays[] = {{.origin = {-1, 0, 0}, .direction = {1, 0, 0}},
                        {.origin = {-1, -1, -1}, .direction = {1, 1, 1}},
                        {.origin = {-1, 0.5, 0}, .direction = {1, 0, 0}},
                        {.origin = {-1, -1, 0}, .direction = {1, 1, 0}}};
    const std::size_t permutations[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    int wrong = 0;
    for (const Ray& ray : rays) {
        for (const auto& p : permutations) {
            for (int mirror = 0; mirror < 8; ++mirror) {
                Ray copy;
                for (std::size_t a = 0; a < 3; ++a) {
                    const bool turn = (mirror >> a) & 1;
                    copy.origin[p[a]] = turn ? 1 - ray.origin[a] : ray.origin[a];
                    copy.direction[p[a]] = turn ? -ray.direction[a] : ray.direction[a];
                }
                for (const CompiledScene* scene : {&cube, &sides}) {
                    const auto hit = scene->closest_hit(copy);
                    wrong += !hit || hit->t != 1;
                }
            }
        }
    }
    CHECK(wrong == 0);
}
