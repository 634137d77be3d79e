// The film's sums.
#include "limn/render/film.h"

#include <limits>

#include "limn/math/error.h"
#include "property.h"
#include "support/random_geometry.h"

namespace limn::film_test {

using namespace test;

TEST_CASE("Film: a pixel is the mean of its samples, and those that are not finite count as black", "[render][film]") {
    Film film(3, 2);
    CHECK(film.add(2, 1, {1, 2, 3}));
    CHECK_FALSE(film.add(2, 1, {kInfinity, 1, 1}));
    CHECK_FALSE(film.add(2, 1, {1, std::nan(""), 1}));
    CHECK_FALSE(film.add(2, 1, {1, 1, -kInfinity}));
    CHECK(film.add(0, 1, {5, 6, 7}));
    const Image image = film.image();
    CHECK(image.width() == 3);
    CHECK(image.height() == 2);
    CHECK(image.at(2, 1) == Color{0.25, 0.5, 0.75});
    CHECK(image.at(0, 1) == Color{5, 6, 7});
    CHECK(image.at(1, 0) == Color{});
    CHECK(film.samples(2, 1) == 4);
    CHECK(film.samples(1, 1) == 0);
    CHECK(film.mean_samples() == 5.0 / 6);
    CHECK(film.memory_bytes() <= 2 * 256 * 80 + 100);  // of a tile, and one that stays black
    CHECK(film.fewest_samples() == 0);
}

TEST_CASE("Film: the order in which pixels get their samples does not matter", "[render][film]") {
    holds([](std::uint64_t seed) {
        Random random(seed);
        const int width = 1 + static_cast<int>(random.index(5)), height = 1 + static_cast<int>(random.index(5)),
                  samples = 4 + static_cast<int>(random.index(5));
        const auto value = [&](int x, int y, int i) {
            Random of_sample(seed + static_cast<std::uint64_t>((y * 8 + x) * 16 + i));
            const double r = of_sample.uniform(), g = of_sample.uniform();
            return Color{r, g, of_sample.log_uniform(1e-3, 1e3)};
        };
        Film pixel_by_pixel(width, height), pass_by_pass(width, height);
        for (int x = 0; x < width; ++x)
            for (int y = height; y-- > 0;)
                for (int i = 0; i < samples; ++i) pixel_by_pixel.add(x, y, value(x, y, i));
        for (int i = 0; i < samples; ++i)
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x) pass_by_pass.add(x, y, value(x, y, i));
        RC_ASSERT(pixel_by_pixel.image() == pass_by_pass.image());
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                for (std::uint32_t r = 0; r < 2; ++r)
                    RC_ASSERT(pixel_by_pixel.replicate_mean(x, y, r) == pass_by_pass.replicate_mean(x, y, r));
                RC_ASSERT(pixel_by_pixel.largest_share(x, y) == pass_by_pass.largest_share(x, y));
            }
    });
}

TEST_CASE("Film: sample i belongs to replicate i mod 2", "[render][film]") {
    Film film(2, 1);
    for (const double value : {1, 2, 3, 4, 5}) film.add(1, 0, {value, 2 * value, 0});
    for (std::uint32_t r = 0; r < 2; ++r) {
        CHECK(film.replicate_samples(1, 0, r) == (r == 0 ? 3 : 2));
        CHECK(film.replicate_mean(1, 0, r) == Color{3, 6, 0});
        CHECK(film.replicate_samples(0, 0, r) == 0);
    }
}

TEST_CASE("Film: a pixel's variance by its replicates, and as that of independent samples", "[render][film]") {
    Film film(1, 1);
    for (const double value : {1, 5, 3, 7}) film.add(0, 0, {value, -2 * value, 1e9 + value});
    // Means 2 and 6: (4 / 2)^2. About their mean of 4 the samples have squares of 20 / 3 a sample, a quarter of that
    // the mean.
    CHECK(film.variance(0, 0) == Color{4, 16, 4});
    CHECK(film.independent_variance(0, 0).r == Approx(5.0 / 3));
    CHECK(film.independent_variance(0, 0).g == Approx(20.0 / 3));
    film.add(0, 0, {4, -8, 4});  // three samples and two, with means of 8/3 and 6: 100 / 9 / (5 (1/3 + 1/2))
    CHECK(film.variance(0, 0).r == Approx(100.0 / 9 / (5 * (1.0 / 3 + 0.5))));
    Film even(1, 1);
    for (int i = 0; i < 8; ++i) even.add(0, 0, {0.1, 1e5 / 3, 7});
    CHECK(even.variance(0, 0) == Color{});
    for (const double v : {even.independent_variance(0, 0).r, even.independent_variance(0, 0).g})
        CHECK((v >= 0 && v < 1e-5));  // rounding alone, never under 0
}

TEST_CASE("Film: the largest share is that of the brightest sample, and all where one sample drowns the others",
          "[render][film]") {
    Film film(3, 1);
    for (const double value : {1, 4, 2, 1}) film.add(0, 0, {0, value, 0});
    CHECK(film.largest_share(0, 0) == Approx(0.5).epsilon(1e-7));  // a float is kept
    for (const double value : {0.0, 1e300, 1.0}) film.add(1, 0, {value, value, value});
    CHECK(film.largest_share(1, 0) > 0);
    CHECK(film.largest_share(1, 0) <= 1);
    CHECK(film.largest_share(2, 0) == 0);
}

}  // namespace limn::film_test
