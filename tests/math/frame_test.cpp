#include "limn/math/frame.h"

#include <cmath>
#include <random>

#include "catch.h"
#include "limn/math/math.h"
#include "limn/math/warp.h"
#include "support/chi_square.h"

namespace limn::frame_test {

namespace {

// Some twenty rounded operations go into each product; the normal itself is unit within three.
constexpr double kTolerance = gamma(32);

void check_orthonormal(const Vec3& n) {
    const Frame f(n);
    const double worst =
        std::max({std::abs(dot(f.x, f.y)), std::abs(dot(f.x, f.z)), std::abs(dot(f.y, f.z)),
                  std::abs(length_squared(f.x) - 1), std::abs(length_squared(f.y) - 1), length(cross(f.x, f.y) - n)});
    if (!(worst <= kTolerance && f.z == n)) {
        CAPTURE(n.x, n.y, n.z, worst);
        FAIL("not a right-handed orthonormal basis");
    }
}

}  // namespace

TEST_CASE("Frame: right-handed and orthonormal around any unit normal", "[core][frame]") {
    std::mt19937_64 random(68);
    for (int i = 0; i < 1'000'000; ++i)
        check_orthonormal(normalize(sample_uniform_sphere(test::uniform(random), test::uniform(random))));
}

TEST_CASE("Frame: no pole at which the basis breaks down", "[core][frame]") {
    for (const double z : {-1.0, -0.0, 0.0, 1.0})
        for (const double tilt : {0.0, 0x1p-1074, 1e-300, 1e-160, 0x1p-54, 0x1p-26, 0x1p-24, 1e-3})
            for (const double sign : {-1.0, 1.0}) check_orthonormal(normalize({sign * tilt, z == 0 ? 1.0 : tilt, z}));
    check_orthonormal(normalize({std::sqrt(0x1p-23), 0, -1 + 0x1p-24}));
}

TEST_CASE("Frame: local and world coordinates are inverse to each other", "[core][frame]") {
    std::mt19937_64 random(2);
    for (int i = 0; i < 1000; ++i) {
        const Frame f(normalize(sample_uniform_sphere(test::uniform(random), test::uniform(random))));
        const Vec3 v{test::uniform(random) - .5, test::uniform(random) - .5, test::uniform(random) - .5};
        CHECK(length(f.to_local(f.to_world(v)) - v) <= kTolerance);
        CHECK(length(f.to_world({0, 0, 1}) - f.z) == 0);
    }
}

}  // namespace limn::frame_test
