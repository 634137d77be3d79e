// The triangle on the sphere of directions: its area there, and that samples divide it as they should.
#include "limn/math/math.h"
#include "property.h"
#include "support/random_geometry.h"
#include "support/single_shading.h"
#include "support/solid_angle.h"

namespace limn::spherical_triangle_test {

using namespace test;

namespace {

const Point3 kEye{};

struct Case {
    Vec3 a, b, c;

    SphericalTriangle whole() const { return {a, b, c}; }
};

// Of any shape, but not so small or thin that the angles drown in rounding.
Case random_case(std::uint64_t seed) {
    Random random(seed);
    for (;;) {
        const Vec3 middle = random.unit();
        const double size = random.log_uniform(0.1, 3);
        const auto corner = [&] { return normalize(middle + size * random.unit()); };
        const Case c{corner(), corner(), corner()};
        const double least = std::min({dot(c.a, c.b), dot(c.b, c.c), dot(c.c, c.a)});
        if (least > -0.95 && std::abs(dot(c.a, cross(c.b, c.c))) > 1e-3) return c;
    }
}

double angle(const Vec3& a, const Vec3& b, const Vec3& c) { return solid_angle(kEye + a, kEye + b, kEye + c, kEye); }

}  // namespace

TEST_CASE("SphericalTriangle: three right angles make an eighth of the sphere", "[render][lights]") {
    CHECK(SphericalTriangle({1, 0, 0}, {0, 1, 0}, {0, 0, 1}).solid_angle() == Approx(kPi / 2).epsilon(1e-14));
    CHECK(SphericalTriangle({1, 0, 0}, {0, 0, 1}, {0, 1, 0}).solid_angle() == Approx(kPi / 2).epsilon(1e-14));
    CHECK(SphericalTriangle({1, 0, 0}, {0, 1, 0}, normalize(Vec3{1, 1, 0})).solid_angle() <= 1e-15);
}

TEST_CASE("SphericalTriangle: its solid angle is the same from either side, and the sum of its parts'",
          "[render][lights]") {
    holds([](std::uint64_t seed) {
        const Case t = random_case(seed);
        const double all = t.whole().solid_angle();
        RC_ASSERT(std::abs(all - angle(t.a, t.b, t.c)) <= 1e-12);
        RC_ASSERT(std::abs(all - SphericalTriangle(t.c, t.b, t.a).solid_angle()) <= 1e-12);
        const Vec3 between = normalize(t.a + t.c);
        const double parts =
            SphericalTriangle(t.a, t.b, between).solid_angle() + SphericalTriangle(between, t.b, t.c).solid_angle();
        RC_ASSERT(std::abs(all - parts) <= 1e-12);
    });
}

TEST_CASE("SphericalTriangle: the arc through the sample of u has passed the share u of the solid angle",
          "[render][lights]") {
    holds([](std::uint64_t seed) {
        const Case t = random_case(seed);
        Random random(seed + 1);
        const double u = random.uniform();
        const Vec3 far = t.whole().sample(u, 1 - 0x1p-53);  // on the side from a to c
        RC_ASSERT(std::abs(length(far) - 1) <= 1e-14);
        RC_ASSERT(std::abs(dot(far, normalize(cross(t.a, t.c)))) <= 1e-7);
        RC_ASSERT(std::abs(angle(t.a, t.b, far) - u * t.whole().solid_angle()) <= 1e-7);
    });
}

TEST_CASE("SphericalTriangle: along its arc 1 - cos of the angle from b grows with v", "[render][lights]") {
    holds([](std::uint64_t seed) {
        const Case t = random_case(seed);
        Random random(seed + 1);
        const double u = random.uniform(), v = random.uniform();
        const Vec3 far = t.whole().sample(u, 1 - 0x1p-53), at = t.whole().sample(u, v);
        RC_ASSERT(std::abs(length(at) - 1) <= 1e-14);
        RC_ASSERT(std::abs((1 - dot(t.b, at)) - v * (1 - dot(t.b, far))) <= 1e-12);
        const Vec3 plane = cross(t.b, far);
        RC_ASSERT(std::abs(dot(at, plane)) <= 1e-12);
        RC_ASSERT(dot(cross(t.b, at), plane) >= 0);
    });
}

TEST_CASE("SphericalTriangle: the corners of the unit square are those of the triangle", "[render][lights]") {
    holds([](std::uint64_t seed) {
        const Case t = random_case(seed);
        const double last = 1 - 0x1p-53;
        RC_ASSERT(length(t.whole().sample(0, 0) - t.b) <= 1e-12);
        RC_ASSERT(length(t.whole().sample(0, last) - t.a) <= 1e-6);
        RC_ASSERT(length(t.whole().sample(last, last) - t.c) <= 1e-6);
    });
}

}  // namespace limn::spherical_triangle_test
