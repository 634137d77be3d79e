// The scenes and rays of `limn bench`, and how it counts.
#include "bench/scenes.h"

#include <cmath>
#include <set>

#include "bench/session.h"
#include "bench/truth.h"
#include "catch.h"
#include "limn/scene/shape/mesh_edges.h"

namespace limn::test {
namespace {

using namespace bench;

constexpr double kTiny = 0.0005;

bool is_float32(double x) { return to_float32(x) == x; }
bool is_float32(const Vec3& v) { return is_float32(v.x) && is_float32(v.y) && is_float32(v.z); }

TEST_CASE("Displaced sphere: closed, outward, of the size that was asked for", "[bench]") {
    for (const double scale : {1e-4, 1e-3, 0.01}) {
        const Geometry g = make_scene("sphere", scale);
        CHECK(count_edges(*g.mesh).is_closed());
        CHECK(stored_primitives(g) == Approx(2e6 * scale).epsilon(0.3));
        // The volume by the divergence theorem: the ball's, but for the hills; negative if normals pointed inward.
        double volume = 0;
        for (const Index3& f : g.mesh->data().triangles) {
            const auto v = [&](std::uint32_t i) {
                const Float3& p = g.mesh->data().vertices[i];
                return Vec3(static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z));
            };
            volume += dot(v(f.a), cross(v(f.b), v(f.c))) / 6;
        }
        CHECK(volume > 2);
        CHECK(volume < 6);
    }
}

TEST_CASE("The scenes have as many primitives as they say", "[bench]") {
    CHECK(stored_primitives(make_scene("soup", 0.01)) == 10000);
    CHECK(stored_primitives(make_scene("spheres", 1)) == 488);
    CHECK(stored_primitives(make_scene("cornell", 1)) == 18);
    const Geometry forest = make_scene("forest", 0.01);
    CHECK(forest.places.size() == 100);
    CHECK(forest.mesh->data().triangles.size() == 100);
    for (const std::string& name : scene_names())
        CHECK(compile(describe(make_scene(name, kTiny))).stats().degenerate == 0);
}

TEST_CASE("What peers are given in float32 is what limn has in double", "[bench]") {
    for (const std::string& name : scene_names()) {
        const Geometry g = make_scene(name, kTiny);
        for (const Ball& ball : g.balls) CHECK((is_float32(ball.center - Point3{}) && is_float32(ball.radius)));
        for (const Parallelogram& q : g.quads)
            CHECK((is_float32(q.corner - Point3{}) && is_float32(q.edge_u) && is_float32(q.edge_v)));
        for (const Transform& place : g.places)
            for (const auto& row : place.rows)
                for (const double entry : row) CHECK(is_float32(entry));
    }
}

TEST_CASE("Bench rays: float32, of every kind, and the same each time", "[bench]") {
    for (const std::string& name : scene_names()) {
        INFO(name);
        const Geometry g = make_scene(name, kTiny);
        const CompiledScene scene = compile(describe(g));
        const auto sets = make_rays(g, scene, 200), again = make_rays(g, scene, 200);
        REQUIRE(sets.size() == again.size());
        std::set<std::string> kinds;
        for (std::size_t s = 0; s < sets.size(); ++s) {
            kinds.insert(sets[s].name);
            CHECK(sets[s].rays.size() <= 200);
            REQUIRE(sets[s].rays.size() == again[s].rays.size());
            for (std::size_t i = 0; i < sets[s].rays.size(); ++i) {
                const Ray& r = sets[s].rays[i];
                const bool good = is_usable(r) && is_float32(r.origin - Point3{}) && is_float32(r.direction) &&
                                  is_float32(r.t_min) && is_float32(r.t_max);
                if (!good || !(r.origin == again[s].rays[i].origin) || !(r.direction == again[s].rays[i].direction))
                    FAIL_CHECK(sets[s].name << ", ray " << i);
            }
        }
        CHECK(sets.front().rays.size() == 200);
        for (const char* kind : {"primary", "diffuse1", "occlusion", "shadow"}) CHECK(kinds.contains(kind));
    }
}

TEST_CASE("Bench rays leave their surface: none meets at once what it left", "[bench]") {
    const Geometry g = make_scene("sphere", 0.001);
    const CompiledScene scene = compile(describe(g));
    for (const RaySet& set : make_rays(g, scene, 2000)) {
        if (set.name == "primary") continue;
        std::size_t near = 0;
        for (const Ray& ray : set.rays) {
            const auto hit = scene.closest_hit(ray);
            near += hit && hit->t * length(ray.direction) < 1e-5 ? 1 : 0;
        }
        INFO(set.name);
        CHECK(near <= set.rays.size() / 100);  // a valley's other side may be near
    }
}

TEST_CASE("Bench answers are the truth, in every scene and for every kind of ray", "[bench]") {
    for (const std::string& name : scene_names()) {
        const Geometry g = make_scene(name, kTiny);
        const CompiledScene scene = compile(describe(g));
        for (const RaySet& set : make_rays(g, scene, 1000)) {
            const Verdict verdict = judge(g, scene, set, 20);
            INFO(name << ", " << set.name << ": " << verdict.first);
            CHECK(verdict.wrong == 0);
            CHECK(verdict.rays >= std::min<std::size_t>(20, set.rays.size()));
        }
    }
}

TEST_CASE("The judge notices answers of another scene", "[bench]") {
    const Geometry g = make_scene("soup", kTiny);
    Geometry other = make_scene("soup", kTiny / 2);
    const CompiledScene scene = compile(describe(g)), wrong = compile(describe(other));
    const RaySet primary = make_rays(g, scene, 400).front();
    CHECK(judge(g, scene, primary, 100).wrong == 0);
    CHECK(judge(g, wrong, primary, 100).wrong > 10);
}

TEST_CASE("Spread: median and quartiles, between neighbours where there is no middle", "[bench]") {
    const Spread odd = spread_of({5, 1, 4, 2, 3});
    CHECK(odd.median == 3);
    CHECK(odd.low == 2);
    CHECK(odd.high == 4);
    CHECK(spread_of({4, 1}).median == 2.5);
    CHECK(spread_of({7}).high == 7);
}

TEST_CASE("Ratios are taken round by round: twice as fast is 2, whatever the machine does meanwhile", "[bench]") {
    const Timing fast{.subject = "a", .seconds = {1, 10, 2}};
    const Timing slow{.subject = "b", .seconds = {2, 20, 4}};
    const Spread r = ratio(fast, slow);
    CHECK(r.median == 2);
    CHECK(r.low == 2);
    CHECK(r.high == 2);
}

TEST_CASE("Measuring counts whose answers differ, on one thread and on two", "[bench]") {
    const Geometry g = make_scene("soup", kTiny), other = make_scene("soup", kTiny / 2);
    const RaySet set = make_rays(g, compile(describe(g)), 5000).front();
    std::vector<std::unique_ptr<Subject>> subjects = build_limn(g, Clock::wall).subjects;
    const std::size_t own = subjects.size();
    for (auto& subject : build_limn(other, Clock::wall).subjects) subjects.push_back(std::move(subject));
    for (const int threads : {1, 2}) {
        const auto timings = measure(subjects, set, threads, 2, [] { return true; });
        REQUIRE(timings.size() == subjects.size());
        for (std::size_t i = 0; i < timings.size(); ++i) {
            CHECK(timings[i].seconds.size() == 2);
            CHECK((timings[i].mismatches == 0) == (i < own));
            CHECK((timings[i].differences == 0) == (i < own));
        }
    }
}

TEST_CASE("Measuring stops when it is told to, with what it has", "[bench]") {
    const Geometry g = make_scene("cornell", 1);
    const RaySet set = make_rays(g, compile(describe(g)), 100).front();
    const auto subjects = build_limn(g, Clock::wall).subjects;
    std::size_t left = subjects.size() + 1;  // each once for its results, and one round of the first
    const auto timings = measure(subjects, set, 1, 100, [&] { return --left > 0; });
    REQUIRE(timings.size() == subjects.size());
    CHECK(timings[0].seconds.size() == 1);
    CHECK(timings[1].seconds.empty());
}

}  // namespace
}  // namespace limn::test
