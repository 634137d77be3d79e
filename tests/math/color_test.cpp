#include "limn/math/color.h"

#include "catch.h"
#include "limn/math/math.h"
#include "math/require.h"
#include "property.h"

namespace limn::color_test {

TEST_CASE("Color: arithmetic works channel by channel", "[core][color]") {
    const Color a{1, 2, 4}, b{8, 0.5, 3};
    CHECK(a + b == Color{9, 2.5, 7});
    CHECK(a - b == Color{-7, 1.5, 1});
    CHECK(a * b == Color{8, 1, 12});
    CHECK(2 * a == Color{2, 4, 8});
    CHECK(a * 2 == Color{2, 4, 8});
    CHECK(a / 2 == Color{0.5, 1, 2});
    Color c = a;
    c += b;
    CHECK(c == a + b);
    c = a;
    c *= b;
    CHECK(c == a * b);
}

TEST_CASE("Color: luminance weighs red, green and blue as BT.709 does, and white by 1", "[core][color]") {
    CHECK(luminance({1, 0, 0}) == 0.2126);
    CHECK(luminance({0, 1, 0}) == 0.7152);
    CHECK(luminance({0, 0, 1}) == 0.0722);
    CHECK(luminance({3, 3, 3}) == Approx(3).epsilon(1e-15));
}

TEST_CASE("Color: the largest channel is found wherever it stands, and black is black in all three", "[core][color]") {
    const double values[] = {-1, 0, 2};
    for (const double r : values)
        for (const double g : values)
            for (const double b : values) {
                CHECK(max_component({r, g, b}) == std::max({r, g, b}));
                CHECK(is_black({r, g, b}) == (r == 0 && g == 0 && b == 0));
                CHECK(is_radiance({r, g, b}) == (r >= 0 && g >= 0 && b >= 0));
                // A reflectance may not give back more than came.
                CHECK(is_reflectance({r / 2, g / 2, b / 2}) == (r >= 0 && g >= 0 && b >= 0));
                CHECK(is_reflectance({r, g, b}) == (std::min({r, g, b}) == 0 && std::max({r, g, b}) == 0));
            }
    for (const double bad : {kInfinity, -kInfinity, std::nan("")})
        for (const Color& c : {Color{bad, 0, 0}, Color{0, bad, 0}, Color{0, 0, bad}}) {
            CHECK_FALSE(is_finite(c));
            CHECK_FALSE(is_radiance(c));
        }
    CHECK(is_finite(Color{1e308, -1e308, 0}));
}

TEST_CASE("sRGB: known values of the standard, black stays black and white white", "[core][color]") {
    CHECK(srgb_encode(0) == 0);
    CHECK(srgb_decode(0) == 0);
    CHECK(srgb_encode(1) == Approx(1).epsilon(1e-15));
    CHECK(srgb_decode(1) == Approx(1).epsilon(1e-15));
    CHECK(srgb_encode(0.002) == Approx(0.02584).epsilon(1e-15));  // on the straight piece: 12.92 x
    CHECK(srgb_decode(0.02584) == Approx(0.002).epsilon(1e-15));
    CHECK(srgb_encode(0x1p-8) == Approx(1.055 * std::exp2(-8 / 2.4) - 0.055).epsilon(1e-14));
    CHECK(srgb_decode(0.5) == Approx(0.21404114048223255).epsilon(1e-14));
    CHECK(srgb_encode(0.21404114048223255) == Approx(0.5).epsilon(1e-14));
    // The two pieces meet to 1e-7: the standard rounds where they do. Each border value belongs to the straight piece.
    CHECK(srgb_encode(0.0031308) == 12.92 * 0.0031308);
    CHECK(srgb_decode(0.04045) == 0.04045 / 12.92);
    CHECK(srgb_encode(std::nextafter(0.0031308, 1)) == Approx(12.92 * 0.0031308).margin(1e-7));
    CHECK(srgb_decode(std::nextafter(0.04045, 1)) == Approx(0.04045 / 12.92).margin(1e-7));
}

TEST_CASE("sRGB: decoding undoes encoding, both rise, and both are odd", "[core][color]") {
    test::holds([](double x, double y) {
        const double back = srgb_decode(srgb_encode(x));
        // Where the pieces meet the standard's own constants part by 1e-7.
        RC_ASSERT(std::abs(back - x) <= 1e-14 * std::abs(x) || std::abs(std::abs(x) - 0.0031308) < 1e-7);
        RC_ASSERT(srgb_encode(-x) == -srgb_encode(x));
        RC_ASSERT(srgb_decode(-x) == -srgb_decode(x));
        if (y - x > 1e-6) RC_ASSERT((srgb_encode(x) < srgb_encode(y) && srgb_decode(x) < srgb_decode(y)));
    });
}

}  // namespace limn::color_test
