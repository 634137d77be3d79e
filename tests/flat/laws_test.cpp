// What a compiled scene's answers may not depend on: the order of description, where the scene stands, how large it is,
// and how many of its shapes are asked at once.
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "catch.h"
#include "geometry/filter.h"
#include "limn/query/compiled_scene.h"
#include "limn/scene/material/lambertian.h"
#include "limn/scene/shape/hittable_list.h"
#include "limn/scene/shape/instance.h"
#include "limn/scene/texture/image_texture.h"
#include "limn/scene/texture/perlin.h"
#include "property.h"
#include "support/cases.h"

namespace limn::laws_test {

using namespace test;

namespace {

std::vector<Case> draw_cases() {
    std::vector<Case> cases(static_cast<std::size_t>(draw_int(1, 24)));
    for (Case& c : cases) c = draw_case();
    return cases;
}

CompiledScene compile_all(const std::vector<Case>& cases) {
    Scene scene;
    for (const Case& c : cases) scene.add(c.shape());
    return compile(scene);
}

bool same(const std::optional<RayHit>& a, const std::optional<RayHit>& b, double t_factor = 1) {
    if (a.has_value() != b.has_value()) return false;
    return !a || (t_factor * a->t == b->t && a->primitive == b->primitive && a->object == b->object && a->u == b->u &&
                  a->v == b->v);
}

}  // namespace

TEST_CASE("CompiledScene: the nearest of what its shapes answer one by one, of equals the first", "[compile][laws]") {
    int hits = 0;
    holds(
        [&] {
            const std::vector<Case> cases = draw_cases();
            const CompiledScene all = compile_all(cases);
            for (const Case& from : cases) {
                std::optional<RayHit> nearest;
                for (std::size_t i = 0; i < cases.size(); ++i) {
                    auto hit = compile_all({cases[i]}).closest_hit(from.ray);
                    if (!hit || (nearest && hit->t >= nearest->t)) continue;
                    hit->object = static_cast<std::uint32_t>(i);
                    hit->primitive = i;  // each shape is one primitive
                    nearest = hit;
                }
                RC_ASSERT(same(nearest, all.closest_hit(from.ray)));
                RC_ASSERT(all.any_hit(from.ray) == nearest.has_value());
                hits += nearest.has_value();
            }
        },
        50);
    CHECK(hits > 250);
}

TEST_CASE("CompiledScene: in another order the same shapes are hit, under other numbers", "[compile][laws]") {
    holds([] {
        std::vector<Case> cases = draw_cases();
        const CompiledScene scene = compile_all(cases);
        const auto shift = static_cast<std::size_t>(draw_int(0, static_cast<int>(cases.size()) - 1));
        std::vector<Case> turned = cases;
        std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(shift), turned.end());
        const CompiledScene other = compile_all(turned);
        for (const Case& from : cases) {
            const auto a = scene.closest_hit(from.ray), b = other.closest_hit(from.ray);
            RC_ASSERT(a.has_value() == b.has_value());
            if (!a) continue;
            RC_ASSERT(a->t == b->t);
            Ray behind = from.ray;  // the second of two at the same t has another number in each order
            behind.t_min = std::nextafter(a->t, -kInfinity), behind.t_max = a->t;
            int at_t = 0;
            for (const Case& c : cases) at_t += c.shape()->hit(behind).has_value();
            if (at_t == 1) RC_ASSERT((b->object + shift) % cases.size() == a->object);
        }
    });
}

TEST_CASE("CompiledScene: moved by whole numbers it is hit alike, to the bit", "[compile][laws]") {
    holds([] {
        const std::vector<Case> cases = draw_cases();
        const Vec3 by = 64 * draw_vec();
        std::vector<Case> moved;
        for (const Case& c : cases) moved.push_back(c.moved(by));
        const CompiledScene a = compile_all(cases), b = compile_all(moved);
        for (std::size_t i = 0; i < cases.size(); ++i)
            RC_ASSERT(same(a.closest_hit(cases[i].ray), b.closest_hit(moved[i].ray)));
    });
}

TEST_CASE("CompiledScene: 2^k times as large it is hit at 2^k times the t, to the bit", "[compile][laws]") {
    holds([] {
        const std::vector<Case> cases = draw_cases();
        const double s = draw_power_of_two(-60, 60);
        std::vector<Case> scaled;
        for (const Case& c : cases) scaled.push_back(c.scaled(s));
        const CompiledScene a = compile_all(cases), b = compile_all(scaled);
        for (std::size_t i = 0; i < cases.size(); ++i)
            RC_ASSERT(same(a.closest_hit(cases[i].ray), b.closest_hit(scaled[i].ray), s));
    });
}

TEST_CASE("CompiledScene: as a list, seen through the identity, it gives the same hits but for the rounding of t",
          "[compile][laws]") {
    holds([] {
        const std::vector<Case> cases = draw_cases();
        const auto list = std::make_shared<HittableList>();
        for (const Case& c : cases) list->add(c.shape());
        Scene scene;
        scene.add(std::make_shared<Instance>(list, Transform{}));
        const CompiledScene plain = compile_all(cases), seen = compile(scene);
        for (const Case& from : cases) {
            const auto a = plain.closest_hit(from.ray), b = seen.closest_hit(from.ray);
            RC_ASSERT(a.has_value() == b.has_value());
            RC_ASSERT((!a || std::abs(a->t - b->t) <= kAccurate * std::abs(a->t)));
            RC_ASSERT((!a || a->t != b->t || a->object == b->element));  // else of two at one place
            RC_ASSERT(seen.any_hit(from.ray) == b.has_value());
        }
    });
}

TEST_CASE("compile: a user's shape whose hit lies outside of the range is not hit, and is not asked for ever",
          "[compile][laws]") {
    class Liar final : public Hittable {
    public:
        explicit Liar(double t) : t_(t) {}
        Box bounds() const override { return {{-1, -1, -1}, {1, 1, 1}}; }
        std::optional<Hit> hit(const Ray&) const override { return Hit{.t = t_, .normal = {0, 0, 1}}; }

    private:
        double t_;
    };
    const auto found = [](double t, double t_min, double t_max) {
        Scene scene;
        scene.add(std::make_shared<Liar>(t));
        const CompiledScene compiled = compile(scene);
        const Ray ray{{0, 0, 9}, {0, 0, -1}, t_min, t_max, 0};
        CHECK(compiled.any_hit(ray) == compiled.closest_hit(ray).has_value());
        return compiled.closest_hit(ray).has_value();
    };
    CHECK(found(9, 0, 20));
    CHECK(found(20, 9, 20));
    for (const double t : {-1.0, 0.0, 20.5, kInfinity, -kInfinity, std::nan("")}) CHECK_FALSE(found(t, 0, 20));
}

TEST_CASE("compile: memory counts what each shape, array, image and lattice takes", "[compile][laws]") {
    const auto bytes = [](const std::function<std::shared_ptr<const Hittable>()>& make, int count) {
        Scene scene;
        for (int i = 0; i < count; ++i) scene.add(make());
        return static_cast<double>(compile(scene).stats().memory_bytes);
    };
    // What one of many takes; `more` is what its numbers need: a reference, two nodes, a range and keeping its owner.
    const auto each = [&](const std::function<std::shared_ptr<const Hittable>()>& make) {
        return (bytes(make, 1001) - bytes(make, 1)) / 1000;
    };
    const auto within = [](double taken, double least, double more = 250) {
        INFO("takes " << taken << ", holds " << least);
        CHECK((taken >= least && taken <= least + more));
    };
    const auto ball = std::make_shared<Sphere>(Point3{}, 1.0, nullptr);
    MeshData data = cube_mesh();
    const double plain = 8 * sizeof(Float3) + 12 * sizeof(Index3);
    within(each([] { return std::make_shared<Sphere>(Point3{}, 1.0, nullptr); }), 40);
    within(each([] { return std::make_shared<Sphere>(Point3{}, Point3{1, 0, 0}, 1.0, nullptr); }), 64);
    within(each([] { return std::make_shared<Triangle>(Point3{}, Point3{1, 0, 0}, Point3{0, 1, 0}, nullptr); }), 80);
    within(each([] { return std::make_shared<Quad>(Point3{}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, nullptr); }), 80);
    within(each([&] { return std::make_shared<Instance>(ball, Transform{}); }), 3 * sizeof(Transform));
    const auto mesh = [&] { return std::make_shared<Mesh>(data, nullptr); };
    // Packed vertices, an id and a place; the arrays only where something is in them that is not packed.
    const double slim = each(mesh), bare = slim - 12 * 4 + plain;
    CHECK(slim >= 12 * (9 + 2) * 4);
    data.normals.assign(8, {0, 0, 1});
    CHECK(std::abs(each(mesh) - (bare + 8 * sizeof(Float3))) < 0.01);
    data.uvs.assign(8, {0, 0});
    CHECK(std::abs(each(mesh) - (bare + 8 * sizeof(Float3) + 8 * sizeof(Float2))) < 0.01);
    data.material_slots.assign(12, 0);
    CHECK(std::abs(each(mesh) - (bare + 8 * sizeof(Float3) + 8 * sizeof(Float2) + 12 * sizeof(std::uint32_t))) < 0.01);
    // A material, a texture and their owners come to about 200 bytes; what a texture looks up counts in full.
    const auto painted = [&](const std::function<std::shared_ptr<const Texture>()>& texture) {
        return each([&] { return std::make_shared<Sphere>(Point3{}, 1.0, std::make_shared<Lambertian>(texture())); });
    };
    within(painted([] { return std::make_shared<ImageTexture>(Image(20, 10)); }), 20 * 10 * 3 * sizeof(float), 500);
    within(painted([] { return std::make_shared<Noise>(1, 1); }), sizeof(PerlinLattice), 500);
    const std::vector<std::shared_ptr<const Material>> slots(8, std::make_shared<Lambertian>(Color{}));
    CHECK(each([&] { return std::make_shared<Mesh>(cube_mesh(), slots); }) == slim + 7 * sizeof(MaterialId));
}

TEST_CASE("compile: of two users' shapes in each other's boxes the nearer is hit, not the one with the lower number",
          "[compile][laws]") {
    class Plate final : public Hittable {
    public:
        Plate(const Box& bounds, double z) : bounds_(bounds), z_(z) {}
        Box bounds() const override { return bounds_; }
        std::optional<Hit> hit(const Ray& ray) const override {
            const double t = (z_ - ray.origin.z) / ray.direction.z;
            if (!(t > ray.t_min && t <= ray.t_max) || !bounds_.contains(ray.at(t))) return std::nullopt;
            return Hit{.t = t, .normal = {0, 0, 1}};
        }

    private:
        Box bounds_;
        double z_;
    };
    // Two boxes like an L, so that they stand in leaves of their own: the second is entered first, and the first before
    // the second is hit.
    Scene scene;
    scene.add(std::make_shared<Plate>(Box{{0, 0, 0}, {1, 1, 100}}, 10.0));
    scene.add(std::make_shared<Plate>(Box{{0, 0, 99}, {100, 1, 101}}, 99.5));
    const auto hit = compile(scene).closest_hit({.origin = {0.5, 0.5, 200}, .direction = {0, 0, -1}});
    REQUIRE(hit);
    CHECK((hit->object == 1 && hit->t == 100.5));
}

}  // namespace limn::laws_test
