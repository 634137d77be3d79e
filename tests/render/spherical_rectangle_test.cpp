// The rectangle on the sphere of directions: its area there, and that samples divide it as they should.
#include "limn/math/frame.h"
#include "limn/math/math.h"
#include "property.h"
#include "support/random_geometry.h"
#include "support/single_shading.h"
#include "support/solid_angle.h"

namespace limn::spherical_rectangle_test {

using namespace test;

namespace {

struct Case {
    Point3 corner, from;
    Vec3 edge_u, edge_v;

    // The part between two fractions of each edge.
    SphericalRectangle part(double u0, double u1, double v0, double v1) const {
        return {corner + u0 * edge_u + v0 * edge_v, (u1 - u0) * edge_u, (v1 - v0) * edge_v, from};
    }
    SphericalRectangle whole() const { return part(0, 1, 0, 1); }
};

// Anywhere, of any shape and from either side, but not so far or flat that the angles drown in rounding.
Case random_case(std::uint64_t seed) {
    Random random(seed);
    const Frame frame(random.unit());
    const double a = random.uniform(0.5, 3), b = random.uniform(0.5, 3);
    const Point3 corner = Point3{} + random.in_cube(10);
    const double height = random.sign() * random.uniform(0.3, 3);
    const Point3 below = corner + random.uniform(-2, 3) * a * frame.x + random.uniform(-2, 3) * b * frame.y;
    return {corner, below + height * frame.z, a * frame.x, b * frame.y};
}

}  // namespace

TEST_CASE("SphericalRectangle: a face of a cube fills a sixth of the directions from its middle", "[render][lights]") {
    CHECK(SphericalRectangle({-1, -1, 1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 0}).solid_angle() ==
          Approx(4 * kPi / 6).epsilon(1e-13));
    CHECK(SphericalRectangle({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, {3, 0, 0}).solid_angle() == 0);  // edge-on
    CHECK(SphericalRectangle({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 0}).solid_angle() == 0);
}

TEST_CASE("SphericalRectangle: its solid angle is that of its two triangles, seen from either side",
          "[render][lights]") {
    holds([](std::uint64_t seed) {
        const Case c = random_case(seed);
        const Point3 b = c.corner + c.edge_u, d = c.corner + c.edge_v, opposite = b + c.edge_v;
        const double truth = solid_angle(c.corner, b, d, c.from) + solid_angle(b, opposite, d, c.from);
        RC_ASSERT(std::abs(c.whole().solid_angle() - truth) <= 1e-12);
    });
}

TEST_CASE("SphericalRectangle: a fraction u of the solid angle lies before the sample of u", "[render][lights]") {
    holds([](std::uint64_t seed) {
        const Case c = random_case(seed);
        Random random(seed + 1);
        const double u = random.uniform(0.01, 0.99), v = random.uniform();
        const Uv at = c.whole().sample(u, v);
        RC_ASSERT(at.u > 0 && at.u < 1 && at.v >= 0 && at.v <= 1);
        RC_ASSERT(std::abs(c.part(0, at.u, 0, 1).solid_angle() - u * c.whole().solid_angle()) <= 1e-11);
        RC_ASSERT(c.whole().sample(u, 1 - v).u == at.u);
    });
}

TEST_CASE("SphericalRectangle: in the strip around a sample a fraction v of it lies before the sample of v",
          "[render][lights]") {
    holds([](std::uint64_t seed) {
        const Case c = random_case(seed);
        Random random(seed + 1);
        const double u = random.uniform(0.01, 0.99), v = random.uniform(0.01, 0.99);
        const Uv at = c.whole().sample(u, v);
        const double half = std::min({1e-3, at.u, 1 - at.u});
        const double strip = c.part(at.u - half, at.u + half, 0, 1).solid_angle(),
                     before = c.part(at.u - half, at.u + half, 0, at.v).solid_angle();
        // The strip bends: in its width w of at most 6e-3, seen from .3 away or more, by (w / .3)^2 at most.
        RC_ASSERT(std::abs(before / strip - v) <= 4e-4);
    });
}

TEST_CASE("SphericalRectangle: the corners of the unit square are those of the rectangle", "[render][lights]") {
    holds([](std::uint64_t seed) {
        const SphericalRectangle r = random_case(seed).whole();
        for (const double u : {0.0, 1 - 0x1p-53})
            for (const double v : {0.0, 1 - 0x1p-53}) {
                const Uv at = r.sample(u, v);
                RC_ASSERT(at.u >= 0 && at.u <= 1 && at.v >= 0 && at.v <= 1);
                RC_ASSERT(std::abs(at.u - u) <= 1e-6 && std::abs(at.v - v) <= 1e-6);
            }
    });
}

}  // namespace limn::spherical_rectangle_test
