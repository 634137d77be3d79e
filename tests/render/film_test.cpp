// The film's sums, and its error estimate on pictures small enough to work out by hand.
#include "render/film.h"

#include "limn/core/error.h"
#include "limn/image/compare.h"
#include "property.h"
#include "support/random_geometry.h"

using namespace limn;
using namespace limn::test;
using tracing::Film;

namespace {

constexpr double kDark = 0.01;  // what relMSE adds to the squared reference

Color grey_of(double v) { return {v, v, v}; }

void fill(Film& film, const std::vector<double>& samples) {
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x)
            for (const double v : samples) film.add(x, y, grey_of(v));
}

// 16 x 16, black but for some pixels of samples 4, 0, 0, 0: mean 1, variance of the mean (9 + 1 + 1 + 1) / (3 * 4) = 1.
Film with_bright_pixels(const std::vector<std::pair<int, int>>& places) {
    Film film(16, 16);
    for (const auto& [x, y] : places) film.add(x, y, grey_of(4));
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            while (film.samples(x, y) < 4) film.add(x, y, {});
    return film;
}

}  // namespace

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
    CHECK(film.memory_bytes() >= 6 * 4 * sizeof(Color));
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
        RC_ASSERT(pixel_by_pixel.error().estimate == pass_by_pass.error().estimate);
        RC_ASSERT(pixel_by_pixel.error().max_sample_share == pass_by_pass.error().max_sample_share);
    });
}

TEST_CASE("Film: one pixel's estimate is the variance between four replicates, relative to its colour",
          "[render][film]") {
    holds([](std::uint64_t seed) {
        Random random(seed);
        const int samples = 4 + static_cast<int>(random.index(20));
        Film film(1, 1);
        std::array<std::vector<double>, 3> values;
        for (int i = 0; i < samples; ++i) {
            const double r = random.uniform(), g = random.uniform(0, 9), b = random.uniform(0, 0.1);
            film.add(0, 0, {r, g, b});
            values[0].push_back(r), values[1].push_back(g), values[2].push_back(b);
        }
        double expected = 0;
        for (const std::vector<double>& v : values) {
            double mean = 0, between = 0;
            for (const double x : v) mean += x / samples;
            for (std::size_t r = 0; r < 4; ++r) {
                double sum = 0, count = 0;
                for (std::size_t i = r; i < v.size(); i += 4) sum += v[i], ++count;
                between += count * (sum / count - mean) * (sum / count - mean);
            }
            expected += between / (3 * samples) / (mean * mean + kDark) / 3;
        }
        const ErrorEstimate e = film.error();
        RC_ASSERT(std::abs(e.estimate - expected) <= 1e-12 * expected);
        RC_ASSERT(std::isnan(e.ci95_low) && std::isnan(e.ci95_high));  // one block has no spread
        RC_ASSERT(e.reason.empty());
    });
}

TEST_CASE("Film: over many films the estimate is the mean squared error, also for uneven replicates",
          "[render][film]") {
    // Uniform samples in [0, 1): variance 1/12. Of 5 samples the replicates hold 2, 1, 1, 1.
    for (const int samples : {4, 5, 7, 16}) {
        Random random(90);
        Film film(64, 64);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x)
                for (int i = 0; i < samples; ++i) film.add(x, y, grey_of(1000 + random.uniform()));
        // At 1000 the denominator is the same to 1e-3 everywhere. Of an estimate from 3 degrees of freedom the relative
        // variance is 2/3 for normal samples; flatter ones have less.
        const double truth = 1.0 / 12 / samples / (1000.5 * 1000.5);
        CHECK(std::abs(film.error().estimate / truth - 1) <= 4.5 * std::sqrt(2.0 / 3 / (64 * 64)) + 1e-3);
    }
}

TEST_CASE("Film: a bright pixel among black ones counts against the 5 x 5 around it, as far as there are pixels",
          "[render][film]") {
    const struct {
        int x, y, around;
    } places[] = {{8, 8, 25},  {2, 2, 25}, {1, 2, 20}, {1, 1, 16},  {0, 0, 9},
                  {15, 15, 9}, {15, 0, 9}, {0, 7, 15}, {13, 14, 20}};
    for (const auto& p : places) {
        CAPTURE(p.x, p.y);
        const ErrorEstimate e = with_bright_pixels({{p.x, p.y}}).error();
        const double block = 1 / (1.0 / p.around / p.around + kDark);  // per channel: variance 1
        CHECK(e.estimate == Approx(block / 256).epsilon(1e-12));
        // One of 64 blocks has it all: the standard error of the sum is that block.
        CHECK(e.ci95_high == Approx(2.96 * e.estimate).epsilon(1e-12));
        CHECK(e.ci95_low == 0);
        CHECK(e.max_sample_share == 0);  // the 99.9th percentile is the second of 256
    }
}

TEST_CASE("Film: a dark pixel among bright ones counts against itself", "[render][film]") {
    Film film(16, 16);
    for (const double v : {0.0, 0.0, 0.0, 0.4}) film.add(8, 8, grey_of(v));  // mean .1, variance of it .01
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            while (film.samples(x, y) < 4) film.add(x, y, grey_of(1));
    CHECK(film.error().estimate == Approx(0.01 / (0.01 + kDark) / 256).epsilon(1e-12));
    CHECK(film.error().ci95_high == Approx(2.96 * film.error().estimate).epsilon(1e-12));
}

TEST_CASE("Film: the interval is 1.96 standard errors of the sum over blocks to either side", "[render][film]") {
    // 2 x 2 pixels a block; half of the 64 blocks have one bright pixel each, all alike in their surround.
    std::vector<std::pair<int, int>> places;
    for (int y = 0; y < 16; y += 2)
        for (int x = (y / 2) % 2 * 2; x < 16; x += 4) places.emplace_back(x, y);
    REQUIRE(places.size() == 32);
    Film film(16, 16);
    for (const auto& [x, y] : places) {
        film.add(x, y, grey_of(1.5));
        for (int i = 0; i < 2; ++i) film.add(x, y, grey_of(1));
        film.add(x, y, grey_of(0.5));  // mean 1, variance of it .5 / 12
    }
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            while (film.samples(x, y) < 4) film.add(x, y, grey_of(1));
    const ErrorEstimate e = film.error();
    const double block = 0.5 / 12 / (1 + kDark);
    CHECK(e.estimate == Approx(32 * block / 256).epsilon(1e-12));
    // Blocks of 0 and b, 32 each: their standard deviation is b / 2 sqrt(64 / 63), and the sum's 8 times that.
    const double standard_error = 8 * block / 2 * std::sqrt(64.0 / 63) / 256;
    CHECK(e.ci95_low == Approx(e.estimate - 1.96 * standard_error).epsilon(1e-12));
    CHECK(e.ci95_high == Approx(e.estimate + 1.96 * standard_error).epsilon(1e-12));
}

TEST_CASE("Film: blocks are an eighth of the shorter side, and those at the borders may be narrower",
          "[render][film]") {
    // 33 x 17: blocks of 2, 17 x 9 of them. One bright pixel, so that the interval tells their number.
    for (const auto& [x, y] : {std::pair{32, 16}, {0, 16}, {32, 0}, {5, 6}}) {
        Film film(33, 17);
        film.add(x, y, grey_of(4));
        for (int j = 0; j < 17; ++j)
            for (int i = 0; i < 33; ++i)
                while (film.samples(i, j) < 4) film.add(i, j, {});
        const ErrorEstimate e = film.error();
        CHECK(e.estimate > 0);
        CHECK(e.ci95_high == Approx(2.96 * e.estimate).epsilon(1e-12));
    }
    Film pair(2, 1);  // two blocks, the fewest that have a spread
    for (int i = 0; i < 4; ++i) pair.add(0, 0, grey_of(i)), pair.add(1, 0, grey_of(1));
    CHECK(pair.error().ci95_high == Approx(2.96 * pair.error().estimate).epsilon(1e-12));
    // Two bright pixels side by side share a block or not: that decides the interval.
    const auto relative_error = [](int x, int width, int height) {
        Film film(width, height);
        for (const int i : {x, x + 1}) film.add(i, height / 2, grey_of(4));
        for (int j = 0; j < height; ++j)
            for (int i = 0; i < width; ++i)
                while (film.samples(i, j) < 4) film.add(i, j, {});
        const ErrorEstimate e = film.error();
        return (e.ci95_high - e.estimate) / (1.96 * e.estimate);
    };
    const auto two_of = [](double n) { return std::sqrt((2 - 4 / n) * n / (n - 1)) / 2; };
    CHECK(relative_error(4, 16, 16) == Approx(1).epsilon(1e-12));
    CHECK(relative_error(5, 16, 16) == Approx(two_of(64)).epsilon(1e-12));
    CHECK(relative_error(5, 40, 24) == Approx(two_of(14 * 8)).epsilon(1e-12));  // blocks of 3
    CHECK(relative_error(6, 40, 24) == Approx(1).epsilon(1e-12));
    CHECK(relative_error(15, 160, 140) == Approx(two_of(10 * 9)).epsilon(1e-12));  // of 16, not more
    CHECK(relative_error(16, 160, 140) == Approx(1).epsilon(1e-12));
    CHECK(relative_error(3, 7, 6) == Approx(two_of(42)).epsilon(1e-12));  // of 1, not less
}

TEST_CASE("Film: the largest share of a sample is that of the pixel behind 99.9 % of the others", "[render][film]") {
    for (const double unit : {1.0, 0x1p-20}) {  // however dark the picture is
        Film film(100, 20);                     // 2000 pixels: the third largest counts
        int place = 0;
        for (const double bright : {8.0, 6.0, 4.0, 2.0}) {
            for (const double v : {bright, 1.0, 1.0, 0.0}) film.add(7 * place + 3, 5 * place, {0, unit * v, 0});
            ++place;
        }
        for (int y = 0; y < 20; ++y)
            for (int x = 0; x < 100; ++x)
                while (film.samples(x, y) < 4) film.add(x, y, unit * Color{1, 1, 1});
        CHECK(film.error().max_sample_share == Approx(4.0 / 6).epsilon(1e-12));
    }
}

TEST_CASE("Film: one pixel short of a sample in each replicate is enough for no estimate", "[render][film]") {
    Film film(4, 4);
    fill(film, {1, 1, 1, 0});
    CHECK(film.error().reason.empty());
    Film poor(4, 4);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x)
            for (int i = 0; i < (x == 2 && y == 3 ? 3 : 6); ++i) poor.add(x, y, {1, 1, 1});
    const ErrorEstimate e = poor.error();
    CHECK_FALSE(e.reason.empty());
    CHECK((std::isnan(e.estimate) && std::isnan(e.ci95_low) && std::isnan(e.ci95_high)));
    CHECK(e.max_sample_share == Approx(1.0 / 6).epsilon(1e-12));
}

// Replicates of 2 samples each have the means 1, 2, 3, 4: variance of the mean 2 (2.25 + 0.25 + 0.25 + 2.25) / (3 * 8).
TEST_CASE("Film: sample i belongs to replicate i mod 4, and the spread of their means is the error",
          "[render][estimate]") {
    tracing::Film film(1, 1);
    for (const double value : {1, 2, 3, 4, 1, 2, 3, 4}) film.add(0, 0, {value, value, value});
    CHECK(film.image().at(0, 0) == Color{2.5, 2.5, 2.5});
    CHECK(film.error().estimate == Approx(10.0 / 24 / (2.5 * 2.5 + 0.01)).epsilon(1e-14));
}
