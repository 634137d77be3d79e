// 8-bit pixels in memory.
#include "limn/image/encode.h"

#include <limits>

#include "catch.h"
#include "limn/math/error.h"

namespace limn::encode_test {

using Bytes = std::vector<std::uint8_t>;

namespace {

Color decoded(int r, int g, int b) { return {srgb_decode(r / 255.0), srgb_decode(g / 255.0), srgb_decode(b / 255.0)}; }

}  // namespace

TEST_CASE("encode_srgb8: pixels row by row, rounded to the nearest step and clamped", "[image][encode]") {
    Image image(2, 2);
    image.set(0, 0, decoded(1, 2, 3));
    image.set(1, 0, decoded(100, 150, 255));
    image.set(0, 1, {-1, 7, std::numeric_limits<double>::infinity()});
    image.set(1, 1, {std::nan(""), -0.0, srgb_decode(99.51 / 255)});
    CHECK(encode_srgb8(image) == Bytes{1, 2, 3, 100, 150, 255, 0, 255, 255, 0, 0, 100});
    CHECK(encode_srgb8(Image()).empty());
}

TEST_CASE("encode_srgb8: a stop of exposure doubles the light", "[image][encode]") {
    const Image image(1, 1, decoded(60, 90, 120));
    const Color half = 0.5 * decoded(60, 90, 120);
    CHECK(encode_srgb8(Image(1, 1, half), 1) == Bytes{60, 90, 120});
    CHECK(encode_srgb8(image, -1) == encode_srgb8(Image(1, 1, half)));
    CHECK(encode_srgb8(image, 20) == Bytes{255, 255, 255});
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()})
        CHECK_THROWS_AS(encode_srgb8(image, bad), ArgumentError);
}

TEST_CASE("encode_srgb8: colours are divided by alpha, and nothing is black", "[image][encode]") {
    Image image(3, 1);
    image.set(0, 0, 0.25 * decoded(60, 90, 120));
    image.set(1, 0, decoded(60, 90, 120));
    const std::vector<float> alpha = {0.25F, 1, 0};
    CHECK(encode_srgb8(image, 0, alpha) == Bytes{60, 90, 120, 64, 60, 90, 120, 255, 0, 0, 0, 0});
    CHECK_THROWS_AS(encode_srgb8(image, 0, std::span(alpha).first(2)), ArgumentError);
}

}  // namespace limn::encode_test
