// Where the error between two images is.
#include <cmath>
#include <limits>
#include <random>

#include "catch.h"
#include "limn/image/compare.h"
#include "limn/math/color.h"
#include "limn/math/error.h"

namespace limn::error_image_test {

namespace {

Image random_image(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    Image image(7, 4);
    for (float& v : image.values()) v = static_cast<float>(random() % 64) / 65;
    return image;
}

// Of a picture whose three channels have this error.
Color shown(float error) { return false_colour(Image(1, 1, {error, error, error})).at(0, 0); }

}  // namespace

TEST_CASE("Error image: each value is its own part of relMSE, which is their mean", "[image][compare]") {
    const Image test = random_image(1), a = random_image(2), b = random_image(3);
    const auto mean = [](const Image& image) {
        double sum = 0;
        for (const float v : image.values()) sum += v;
        return sum / static_cast<double>(image.values().size());
    };
    CHECK(mean(error_image(test, a)) == Approx(compare_images(test, a).relative_mse).epsilon(1e-6));
    CHECK(mean(error_image(test, a, b)) == Approx(compare_images(test, a, b).relative_mse).epsilon(1e-6));
    Image one = a;
    one.set(5, 2, {a.at(5, 2).r, a.at(5, 2).g + 0.5, a.at(5, 2).b});
    const Image error = error_image(one, a);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 7; ++x) CHECK((x == 5 && y == 2) != (error.at(x, y) == Color{}));
    CHECK(error.at(5, 2).g == Approx(0.25 / (std::pow(a.at(5, 2).g, 2) + 0.01)).epsilon(1e-6));
    CHECK((error.at(5, 2).r == 0 && error.at(5, 2).b == 0));
    CHECK_FALSE(error_image(a, one) == error);  // relative to the reference
}

TEST_CASE("Error image: what is not finite is NaN there and nowhere else, and green to the eye", "[image][compare]") {
    Image test = random_image(1);
    const Image reference = random_image(2);
    test.set(2, 1, {std::numeric_limits<double>::infinity(), 0, 0});
    const Image error = error_image(test, reference);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 7; ++x) {
            const bool bad = x == 2 && y == 1;
            CHECK(std::isnan(error.at(x, y).r) == bad);
            CHECK_FALSE(std::isnan(error.at(x, y).g));
            CHECK((false_colour(error).at(x, y) == Color{0, 1, 0}) == bad);
        }
}

TEST_CASE("False colour: from black to white by decades, brighter with every error that is larger",
          "[image][compare]") {
    CHECK(shown(0) == Color{});
    CHECK(shown(1e-6f) == Color{});
    CHECK(shown(1) == Color{1, 1, 1});
    CHECK(shown(1e20f) == Color{1, 1, 1});
    CHECK(shown(1e-5f).b > 3 * shown(1e-5f).r);
    CHECK(shown(1e-3f).r > 3 * shown(1e-3f).b);
    double last = -1;
    for (double exponent = -6; exponent <= 0; exponent += 0.125) {
        const double brightness = luminance(shown(static_cast<float>(std::pow(10, exponent))));
        CHECK(brightness > last);
        last = brightness;
    }
    // The mean of the channels decides.
    CHECK(false_colour(Image(1, 1, {3e-4, 0, 0})).at(0, 0).r == Approx(shown(1e-4f).r).epsilon(1e-5));
}

TEST_CASE("Error image: sizes must agree", "[image][compare]") {
    const Image a(2, 3), b(3, 2);
    CHECK_THROWS_AS(error_image(a, b), ArgumentError);
    CHECK_THROWS_AS(error_image(a, a, b), ArgumentError);
    CHECK_THROWS_AS(error_image(Image(), Image()), ArgumentError);
}

}  // namespace limn::error_image_test
