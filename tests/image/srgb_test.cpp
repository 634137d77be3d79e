#include <cmath>

#include "catch.h"
#include "limn/math/color.h"
#include "property.h"

namespace limn::srgb_test {

TEST_CASE("sRGB: decoding and encoding all 256 stored values is the identity", "[image][color]") {
    for (int i = 0; i < 256; ++i) {
        const float linear = static_cast<float>(srgb_decode(i / 255.0));
        CHECK(std::floor(255 * srgb_encode(linear) + 0.5) == i);
    }
}

TEST_CASE("sRGB: known values of IEC 61966-2-1", "[image][color]") {
    CHECK(srgb_encode(0) == 0);
    CHECK(srgb_encode(1) == Approx(1).epsilon(1e-15));
    CHECK(srgb_decode(1) == Approx(1).epsilon(1e-15));
    CHECK(srgb_encode(0.001) == Approx(0.01292).epsilon(1e-15));            // the straight part
    CHECK(srgb_decode(0.5) == Approx(0.21404114048223255).epsilon(1e-14));  // 0.5555 / 1.055 to the 2.4
    CHECK(srgb_encode(0.21404114048223255) == Approx(0.5).epsilon(1e-14));
}

TEST_CASE("sRGB: both functions are odd", "[image][color]") {
    const double x = GENERATE(0.0, 0.002, 0.3, 1.0, 7.0);
    CHECK(srgb_encode(-x) == -srgb_encode(x));
    CHECK(srgb_decode(-x) == -srgb_decode(x));
    CHECK(std::signbit(srgb_encode(-0.0)));
}

TEST_CASE("sRGB: encoding never decreases", "[image][color]") {
    double last = -1;
    for (int i = 0; i <= 100000; ++i) {
        const double encoded = srgb_encode(i / 100000.0);
        REQUIRE(encoded >= last);
        last = encoded;
    }
}

TEST_CASE("sRGB: each function undoes the other, and both are increasing", "[image][color]") {
    test::holds([](std::uint32_t a, std::uint32_t b) {
        const double x = std::ldexp(a, -31), y = std::ldexp(b, -31);  // in [0, 2)
        // Where the straight part ends the rounded constants of the standard leave a step of some 1e-8.
        RC_ASSERT(std::abs(srgb_decode(srgb_encode(x)) - x) <= 1e-7);
        RC_ASSERT(std::abs(srgb_encode(srgb_decode(x)) - x) <= 1e-6);
        if (x < y) RC_ASSERT(srgb_encode(x) < srgb_encode(y) && srgb_decode(x) < srgb_decode(y) + 1e-8);
    });
}

}  // namespace limn::srgb_test
