#include "limn/scene/shape/instance.h"

#include "catch.h"
#include "limn/math/error.h"
#include "limn/scene/shape/mesh.h"
#include "limn/scene/shape/quad.h"
#include "limn/scene/shape/sphere.h"
#include "limn/scene/shape/triangle.h"
#include "support/exact_truth.h"
#include "support/meshes.h"
#include "support/random_geometry.h"
#include "support/tally.h"

namespace limn::instance_test {

using limn::test::Random;
using limn::test::Tally;

namespace {

constexpr double kUlp = 0x1p-23;

std::shared_ptr<const Hittable> unit_sphere() { return std::make_shared<Sphere>(Point3{0, 0, 0}, 1.0, nullptr); }

// The 48 signed permutations of the axes.
std::vector<Transform> signed_permutations() {
    std::vector<Transform> all;
    const std::size_t permutations[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    for (const auto& p : permutations) {
        for (int signs = 0; signs < 8; ++signs) {
            Transform m;
            m.rows = {};
            for (std::size_t a = 0; a < 3; ++a) m.rows[a][p[a]] = (signs >> a) & 1 ? -1 : 1;
            all.push_back(m);
        }
    }
    return all;
}

}  // namespace

TEST_CASE("Instance: a scaled and moved sphere is hit where exact arithmetic hits it", "[shape][instance]") {
    Random random(60);
    for (const double s : {1e-3, 1.0, 1e3}) {
        for (const double shift : {0.0, 1e3, 1e5}) {
            const Transform world = Transform::translate({shift, -shift, shift}) * Transform::scale(s, s, s);
            const Instance instance(unit_sphere(), world);
            Tally tally;
            for (int i = 0; i < 3000; ++i) {
                const Point3 center{shift, -shift, shift};
                const Point3 origin = center + 10 * s * random.unit();
                const Ray ray{.origin = origin, .direction = center + 1.5 * s * random.in_cube() - origin};
                const auto hit = instance.hit(ray);
                const test::ExactHit truth = test::exact_sphere_hit({0, 0, 0}, 1, ray, {&world, 1});
                ++tally.rays;
                if (hit.has_value() != truth.hit) {
                    tally.fault(ray, "decision");
                } else if (hit && test::absolute(test::Real(hit->t) - truth.t) > test::Real(kUlp) * truth.t) {
                    tally.fault(ray, "t");
                }
            }
            INFO("scale " << s << ", shift " << shift << ": " << tally.first);
            CHECK(tally.wrong == 0);
            CHECK(tally.rays == 3000);
        }
    }
}

TEST_CASE("Instance: eight nested turns by 45 degrees change nothing", "[shape][instance]") {
    Random random(61);
    const auto mesh = std::make_shared<Mesh>(test::icosphere(1), nullptr);
    for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 2, 3}}) {
        std::shared_ptr<const Hittable> turned = mesh;
        for (int i = 0; i < 8; ++i) turned = std::make_shared<Instance>(turned, Transform::rotate(axis, 45));
        Tally tally;
        for (int i = 0; i < 2000; ++i) {
            const Point3 origin = Point3{} + 5 * random.unit();
            const Ray ray{.origin = origin, .direction = Point3{} + 0.8 * random.unit() - origin};
            const auto a = mesh->hit(ray), b = turned->hit(ray);
            if (a.has_value() != b.has_value() || (a && std::abs(a->t - b->t) > 4 * kUlp * a->t))
                tally.fault(ray, "moved");
            if (a && b && a->element == b->element && length(Vec3(a->normal) - Vec3(b->normal)) > 1e-6)
                tally.fault(ray, "normal");
        }
        INFO(tally.first);
        CHECK(tally.wrong == 0);
    }
}

TEST_CASE("Instance: permutations and mirrors of the axes are exact, and keep outside outside", "[shape][instance]") {
    Random random(62);
    const auto sphere = std::make_shared<Sphere>(Point3{0.5, 0.25, -0.125}, 0.75, nullptr);
    for (const Transform& m : signed_permutations()) {
        const Instance instance(sphere, m);
        for (int i = 0; i < 50; ++i) {
            const Point3 origin = Point3{} + 3 * random.unit();
            const Vec3 d = Point3{0.5, 0.25, -0.125} + 0.6 * random.unit() - origin;
            const auto plain = sphere->hit({.origin = origin, .direction = d});
            const auto seen = instance.hit({.origin = transform_point(m, origin), .direction = transform_vector(m, d)});
            REQUIRE((plain && seen));
            CHECK(plain->t == seen->t);
            CHECK(plain->u == seen->u);
            CHECK(length(Vec3(seen->normal) - transform_vector(m, Vec3(plain->normal))) <= 4e-16);  // made unit again
            CHECK(dot(seen->normal, transform_vector(m, d)) < 0);
        }
    }
}

TEST_CASE("Instance: under stretch and shear t stays the object's, normals go by the inverse transpose",
          "[shape][instance]") {
    Random random(63);
    Transform m = Transform::scale(1, 1e-3, 1e3);
    m.rows[0][1] = 0.3, m.rows[0][2] = -200, m.rows[1][2] = 0.1;
    m = Transform::translate({5, -3, 1}) * m;
    const Sphere plain({0, 0, 0}, 1, nullptr);
    const Instance instance(unit_sphere(), m);
    for (int i = 0; i < 2000; ++i) {
        const Point3 origin = Point3{} + 3 * random.unit();
        const Vec3 d = Point3{} + 0.7 * random.unit() - origin;
        const auto expected = plain.hit({.origin = origin, .direction = d});
        const Ray world{.origin = transform_point(m, origin), .direction = transform_vector(m, d)};
        const auto hit = instance.hit(world);
        REQUIRE((expected && hit));
        CHECK(std::abs(hit->t - expected->t) <= 2 * kUlp * expected->t);
        const Vec3 n = normalize(Vec3(transform_normal(inverse(m), expected->normal)));
        CHECK(length(cross(Vec3(hit->normal), n)) <= 1e-6);
        CHECK(length(Vec3(hit->normal)) == Approx(1).epsilon(1e-14));
        CHECK(dot(hit->normal, world.direction) < 0);
    }
}

TEST_CASE("Instance: elements, u, v and texture coordinates are the object's own", "[shape][instance]") {
    MeshData data = test::cube_mesh();
    for (int i = 0; i < 8; ++i) data.uvs.push_back({static_cast<float>(i) / 8, 1 - static_cast<float>(i) / 8});
    const auto mesh = std::make_shared<Mesh>(data, nullptr);
    const Instance instance(mesh, Transform::translate({8, 0, 0}) * Transform::scale(2, 2, 2));
    const auto a = mesh->hit({.origin = {0.25, 0.625, 3}, .direction = {0, 0, -1}});
    const auto b = instance.hit({.origin = {8.5, 1.25, 6}, .direction = {0, 0, -2}});
    REQUIRE((a && b));
    CHECK((a->t == b->t && a->element == b->element && a->u == b->u && a->v == b->v));
    CHECK((a->uv && b->uv && *a->uv == *b->uv));
}

TEST_CASE("Instance: shading normals go by the inverse transpose as well, and are unit, and none stays none",
          "[shape][instance]") {
    MeshData data = test::icosphere(1);
    for (const Float3& p : data.vertices) data.normals.push_back({p.x, 2 * p.y, p.z});
    const auto smooth = std::make_shared<Mesh>(data, nullptr);
    Transform m = Transform::translate({5, -3, 1}) * Transform::scale(-1, 4, 0.5);
    m.rows[0][1] = 0.75;
    const Instance instance(smooth, m), still(unit_sphere(), m);
    Random random(66);
    for (int i = 0; i < 500; ++i) {
        const Point3 origin = Point3{} + 3 * random.unit();
        const Vec3 d = Point3{} + 0.7 * random.unit() - origin;
        const Ray world{.origin = transform_point(m, origin), .direction = transform_vector(m, d)};
        const auto own = smooth->hit({.origin = origin, .direction = d}), seen = instance.hit(world);
        REQUIRE((own && seen && own->element == seen->element));
        const Vec3 n = normalize(Vec3(transform_normal(inverse(m), own->shading_normal)));
        CHECK(length(Vec3(seen->shading_normal) - n) <= 1e-12);
        CHECK(still.hit(world)->shading_normal == Normal3{});
    }
}

TEST_CASE("Instance: the error bound holds the object's own, stretched, and the rounding of both ways",
          "[shape][instance]") {
    const auto error = [](const Transform& m, const Point3& center) {
        const auto hit = Instance(std::make_shared<Sphere>(center, 1.0, nullptr), m)
                             .hit({.origin = transform_point(m, center + Vec3{0, 0, 3}),
                                   .direction = transform_vector(m, {0, 0, -1})});
        REQUIRE(hit);
        return max_abs(hit->position_error);
    };
    const double own = error(Transform{}, {});
    CHECK(own >= gamma(64));
    CHECK(own <= 8 * gamma(64));
    // Stretched along any axis: 8 of the object's own 1 and of the way in, which rounds the world's coordinate, 1 or 8.
    CHECK(error(Transform::scale(8, 1, 1), {}) >= 8 * (1 + 1) * gamma(64));
    CHECK(error(Transform::scale(1, 8, 1), {}) >= 8 * (1 + 1) * gamma(64));
    CHECK(error(Transform::scale(1, 1, 8), {}) >= 8 * (1 + 8) * gamma(64));
    CHECK(error(Transform{}, {1024, 0, 0}) >= 1024 * gamma(64));               // where the object is in its space
    CHECK(error(Transform::translate({0, 1024, 0}), {}) >= 1024 * gamma(64));  // where it is in the world
    CHECK(error(Transform::translate({0, 1024, 0}), {0, -1024, 0}) >= 1024 * gamma(64));  // though these cancel
    // The way in is rounded in the object's units, which the way out stretches: 1024 / 2^-10, seen at 2^-10.
    CHECK(error(Transform::translate({1024, 0, 0}) * Transform::scale(1, 0x1p-10, 1), {}) >= 0x1p20 * gamma(64));
}

TEST_CASE("Instance: motion is bit-exact at both ends, clamped outside, entry by entry between", "[shape][instance]") {
    Random random(64);
    const Transform m0 = Transform::translate({1, 2, 3}) * Transform::rotate_y(20);
    const Transform m1 = Transform::translate({-4, 2, 5}) * Transform::rotate_y(80) * Transform::scale(2, 1, 1);
    const auto mesh = std::make_shared<Mesh>(test::icosphere(1), nullptr);
    const Instance moving(mesh, m0, m1), first(mesh, m0), last(mesh, m1);
    for (int i = 0; i < 1000; ++i) {
        const double time = random.uniform();
        const Instance between(mesh, interpolate(m0, m1, time));
        const Point3 origin = Point3{} + 20 * random.unit();
        for (const auto& [at, still] :
             {std::pair<double, const Instance*>{0, &first}, {1, &last}, {-1, &first}, {2, &last}, {time, &between}}) {
            const Ray ray{
                .origin = origin, .direction = still->bounds().center() + 0.8 * random.unit() - origin, .time = at};
            const auto a = moving.hit(ray), b = still->hit(ray);
            REQUIRE(a.has_value() == b.has_value());
            if (a) CHECK((a->t == b->t && a->element == b->element && a->normal == b->normal));
        }
    }
    // Equal matrices at both ends: a still object.
    const Instance still(mesh, m0, m0);
    const Ray ray{.origin = {1, 2, 20}, .direction = {0, 0, -1}, .time = 0.3};
    CHECK(still.hit(ray)->t == first.hit(ray)->t);
    CHECK(still.bounds() == first.bounds());
    CHECK(still.bounds() == transform_box(m0, mesh->bounds()));
}

TEST_CASE("Instance: the box of a moving instance contains the object at every time", "[shape][instance]") {
    Random random(65);
    const MeshData data = test::icosphere(0);
    const auto mesh = std::make_shared<Mesh>(data, nullptr);
    int outside = 0;
    for (int motion = 0; motion < 300; ++motion) {
        const auto pose = [&] {
            return Transform::translate(random.in_cube(random.log_uniform(1e-2, 1e6))) *
                   Transform::rotate(random.unit(), random.uniform(-60, 60)) *
                   Transform::scale(1, random.uniform(0.5, 2), 3);
        };
        const Transform m0 = pose();
        const Transform m1 =
            Transform::translate(random.in_cube(10)) * Transform::rotate(random.unit(), random.uniform(-60, 60)) * m0;
        const Instance instance(mesh, m0, m1);
        const Box box = instance.bounds();
        for (int i = 0; i < 30; ++i) {
            const Transform m = interpolate(m0, m1, i < 2 ? i : random.uniform());
            for (std::uint32_t v = 0; v < data.vertices.size(); ++v) {
                const test::Real3 p = test::transform_point(m, test::Real3(test::vertex(data, v)));
                const test::Real at[3] = {p.x, p.y, p.z};
                for (std::size_t a = 0; a < 3; ++a)
                    outside += at[a] < test::Real(box.lower[a]) || at[a] > test::Real(box.upper[a]);
            }
        }
    }
    CHECK(outside == 0);
}

TEST_CASE("Instance: a singular or non-finite matrix is refused, at any time of the shutter", "[shape][instance]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(Instance(nullptr, Transform{}), ArgumentError);
    CHECK_THROWS_AS(Instance(unit_sphere(), Transform::scale(1, 0, 1)), ArgumentError);
    CHECK_THROWS_AS(Instance(unit_sphere(), Transform::scale(1, nan, 1)), ArgumentError);
    CHECK_THROWS_AS(Instance(unit_sphere(), Transform::translate({kInfinity, 0, 0})), ArgumentError);
    CHECK_THROWS_AS(Instance(unit_sphere(), Transform{}, Transform::scale(1, 1, 0)), ArgumentError);
    CHECK_THROWS_AS(Instance(unit_sphere(), Transform::translate({0, nan, 0}), Transform{}), ArgumentError);
    // Both ends are fine, the way between is not: entry by entry a half turn shrinks to nothing at its middle.
    CHECK_THROWS_AS(Instance(unit_sphere(), Transform{}, Transform::rotate_y(180)), ArgumentError);
    CHECK_THROWS_AS(Instance(unit_sphere(), Transform{}, Transform::scale(-1, 1, 1)), ArgumentError);
    // det = (1-2t)^2 touches zero without a change of sign; so it does at t = 1/3 here.
    CHECK_THROWS_AS(Instance(unit_sphere(), Transform{}, Transform::scale(-2, -2, 1)), ArgumentError);
    CHECK_NOTHROW(Instance(unit_sphere(), Transform{}, Transform::rotate_y(175)));
    CHECK_NOTHROW(Instance(unit_sphere(), Transform::scale(-1, 1, 1), Transform::scale(-2, 1, 1)));
    CHECK_NOTHROW(Instance(unit_sphere(), Transform::scale(1e-60, 1e-60, 1e-60)));
    for (const double s : {1e-3, 1e-6, 1e-12, 1e-60})
        CHECK_NOTHROW(Instance(unit_sphere(), Transform{}, Transform::scale(s, s, s)));
}

TEST_CASE("Instance: an unusable ray misses", "[shape][instance]") {
    const Instance instance(unit_sphere(), Transform::scale(2, 2, 2));
    for (const Ray& ray : test::unusable_rays()) CHECK_FALSE(instance.hit(ray));
}

TEST_CASE("Instance: whether a motion is singular does not depend on its size", "[shape][instance]") {
    for (const double size : {1e-100, 1e-54, 1.0, 1e54, 1e100}) {
        CAPTURE(size);
        const auto of = [&](double s) { return Transform::scale(s * size, s * size, s * size); };
        const auto moving = [&](const Transform& end) { return Instance(unit_sphere(), of(1), end * of(1)); };
        CHECK_THROWS_AS(Instance(unit_sphere(), of(1), of(-1)), ArgumentError);
        CHECK_THROWS_AS(moving(Transform::rotate_y(180)), ArgumentError);
        CHECK_NOTHROW(moving(Transform::rotate_y(150)));
        CHECK_NOTHROW(Instance(unit_sphere(), of(1), Transform{}));
    }
}

}  // namespace limn::instance_test
