// The error estimate, on films small enough to work out by hand and on others whose truth is known.
#include "render/error_estimate.h"

#include <boost/math/distributions/fisher_f.hpp>

#include "property.h"
#include "support/random_geometry.h"

namespace limn::error_estimate_test {

using namespace test;
using transport::estimate_error;

namespace {

// Boost's tables of long double cannot be set up under valgrind.
using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

constexpr double kDark = 0.01;  // what relMSE adds to the squared reference

Color grey_of(double v) { return {v, v, v}; }
double square(double x) { return x * x; }

void fill(Film& film, const std::vector<double>& samples) {
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x)
            for (const double v : samples) film.add(x, y, grey_of(v));
}

// 16 x 16, all `around` but for one pixel.
Film with_one_pixel(int at_x, int at_y, const std::vector<double>& samples, double around) {
    Film film(16, 16);
    for (const double v : samples) film.add(at_x, at_y, grey_of(v));
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            while (film.samples(x, y) < samples.size()) film.add(x, y, grey_of(around));
    return film;
}

// Normal by the central limit: the sum of twelve has variance 1.
double normal(Random& random) {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += random.uniform();
    return sum;
}

}  // namespace

TEST_CASE("Error estimate: a pixel alone has the variance between its replicates over the square of its mean",
          "[render][estimate]") {
    holds([](std::uint64_t seed) {
        Random random(seed);
        const int samples = 8 + static_cast<int>(random.index(20));
        Film film(1, 1);
        std::array<double, 2> sums{}, counts{};
        for (int i = 0; i < samples; ++i) {
            const double value = random.uniform(0, 9);
            film.add(0, 0, grey_of(value));
            const auto half = static_cast<std::size_t>(i % 2);
            sums[half] += value, ++counts[half];
        }
        const double mean = (sums[0] + sums[1]) / samples;
        const double variance =
            square(sums[0] / counts[0] - sums[1] / counts[1]) / (samples * (1 / counts[0] + 1 / counts[1]));
        const ErrorEstimate e = estimate_error(film);
        RC_ASSERT(std::abs(e.estimate - variance / (mean * mean + kDark)) <= 1e-12 * e.estimate);
        RC_ASSERT(e.reason.empty());
    });
}

// Replicates of four samples each have the means 101 and 103: variance of the mean 1.
TEST_CASE("Error estimate: means of 101 and 103 are off by 1, squared", "[render][estimate]") {
    Film film(1, 1);
    for (const double value : {101, 103, 100, 104, 102, 102, 101, 103}) film.add(0, 0, grey_of(value));
    CHECK(film.image().at(0, 0) == grey_of(102));
    CHECK(estimate_error(film).estimate == Approx(1 / (102.0 * 102.0 + kDark)).epsilon(1e-12));
}

TEST_CASE("Error estimate: over many pixels it is the mean squared error, also for uneven replicates",
          "[render][estimate]") {
    // Uniform samples in [0, 1): variance 1/12. Of 9 samples the replicates hold 5 and 4.
    for (const int samples : {8, 9, 11, 16}) {
        Random random(90);
        Film film(64, 64);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x)
                for (int i = 0; i < samples; ++i) film.add(x, y, grey_of(1000 + random.uniform()));
        // At 1000 the denominator is the same to 1e-3 everywhere. Of an estimate from one degree of freedom the
        // relative variance is 2 for normal samples; flatter ones have less.
        const double truth = 1.0 / 12 / samples / (1000.5 * 1000.5);
        CHECK(std::abs(estimate_error(film).estimate / truth - 1) <= 4.5 * std::sqrt(2.0 / (64 * 64)) + 1e-3);
    }
}

TEST_CASE("Error estimate: a firefly counts against the pixels around it, as far as there are pixels",
          "[render][estimate]") {
    // Black but for one sample of 8000: replicates of 2000 and 0, variance of the mean 1e6. The pixels around are
    // black, and nothing in them is as bright.
    for (const auto& [x, y] : {std::pair{8, 8}, {1, 1}, {0, 0}, {15, 15}, {15, 0}, {0, 7}}) {
        CAPTURE(x, y);
        const Film film = with_one_pixel(x, y, {8000, 0, 0, 0, 0, 0, 0, 0}, 0);
        CHECK(estimate_error(film).estimate == Approx(1e6 / kDark / 256).epsilon(1e-7));
    }
}

TEST_CASE("Error estimate: a pixel that differs from those around by more than its noise counts against itself",
          "[render][estimate]") {
    // Noise far under the difference: the pixel's own mean to a thousandth, whatever is around.
    const std::vector<double> samples{10.1, 10, 10, 9.9, 10, 10, 10.1, 9.9};  // replicates of 10.05 and 9.95
    for (const double around : {0.0, 1.0, 100.0})
        CHECK(estimate_error(with_one_pixel(8, 8, samples, around)).estimate ==
              Approx(square(0.05) / (100 + kDark) / 256).epsilon(2e-3));
}

TEST_CASE("Error estimate: rare bright samples do not hide their own error", "[render][estimate]") {
    // Four fifths of a pixel's light comes in flashes, of which a sample has 0.64 / (8 e): for a relMSE of e.
    for (const double error : {1e-1, 1e-2, 1e-3}) {
        Random random(31);
        const int side = 120;
        Film film(side, side);
        const double flashes = 0.64 / (8 * error);
        double truth = 0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                for (int r = 0; r < 8; ++r) {
                    double count = 0;  // Poisson, by its definition: arrivals until time `flashes`
                    for (double t = -std::log1p(-random.uniform()); t < flashes; t -= std::log1p(-random.uniform()))
                        ++count;
                    film.add(x, y, grey_of(0.2 + 0.8 * count / flashes));
                }
                truth += square(film.mean(x, y).r - 1) / (1 + kDark) / (side * side);
            }
        CAPTURE(error);
        // Truth and estimate together have a relative variance of 4 over the pixels. The mean of eight pixels, which is
        // divided by, has a relative variance of e / 8, three times of which the mean of its inverse square exceeds.
        const double ratio = estimate_error(film).estimate / truth;
        CHECK(ratio >= 1 - 4.5 * 2 / side - 0.05);
        CHECK(ratio <= 1 + 4.5 * 2 / side + 3 * error / 8 + 0.05);
    }
}

TEST_CASE("Error estimate: true over estimated error of n equal pixels is spread as F with n and n degrees",
          "[render][estimate]") {
    // The logarithm's normal approximation is worst where there is one value alone.
    const struct {
        double values, tolerance;
    } rows[] = {{1, 0.05}, {2, 0.03}, {5, 0.02}, {30, 4e-3}, {1000, 1e-4}, {1e6, 1e-6}};
    for (const auto& row : rows) {
        CAPTURE(row.values);
        const boost::math::fisher_f_distribution<double, InDouble> f(row.values, row.values);
        const double quantile = std::log(boost::math::quantile(f, 0.975));
        CHECK(1.959964 * transport::ratio_deviation(row.values) == Approx(quantile).epsilon(row.tolerance));
    }
}

TEST_CASE("Error estimate: one noisy pixel is worth one value, ten thousand with equal noise ten thousand",
          "[render][estimate]") {
    const auto width_of = [](const ErrorEstimate& e) { return std::log(e.ci95_high / e.estimate); };
    const Film one = with_one_pixel(8, 8, {11, 10, 10, 9, 11, 9, 10, 10}, 1);
    CHECK(width_of(estimate_error(one)) >= 1.959964 * transport::ratio_deviation(1) * (1 - 1e-9));
    Random random(12);
    Film equal(100, 100);
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 100; ++x)
            for (int i = 0; i < 8; ++i) equal.add(x, y, grey_of(1000 + normal(random)));
    const double width = width_of(estimate_error(equal)), ideal = 1.959964 * transport::ratio_deviation(1e4);
    // No more values count than there are pixels. The sum of squares counts as a standard error larger; where noise
    // makes pixels differ by chance, these count by their own squares.
    CHECK(width >= ideal * (1 - 1e-9));
    CHECK(width <= ideal * 1.1);
}

TEST_CASE("Error estimate: of pictures with normal noise, 95 in 100 have their true error in the interval",
          "[render][estimate]") {
    // Few pixels of very unequal noise, where it matters most.
    for (const int side : {1, 3, 8}) {
        Random random(77);
        const int pictures = 1500;
        int inside = 0, under = 0;
        for (int i = 0; i < pictures; ++i) {
            Film film(side, side);
            double truth = 0;
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x) {
                    const double noise = 1 + x * y;
                    for (int s = 0; s < 8; ++s) film.add(x, y, grey_of(1000 + noise * normal(random)));
                    truth += square(film.mean(x, y).r - 1000) / (1e6 + kDark) / (side * side);
                }
            const ErrorEstimate e = estimate_error(film);
            inside += truth >= e.ci95_low && truth <= e.ci95_high;
            under += truth <= e.ci95_high;
        }
        CAPTURE(side, inside, under);
        // 4.5 standard errors of a share; above, the approximations may err on the safe side. Of nine pixels of which
        // one has half of the noise, it is not known well how many values they are worth.
        const double least = side == 3 ? 0.9 : 0.95;
        CHECK(inside >= pictures * (least - 4.5 * std::sqrt(least * (1 - least) / pictures)));
        CHECK(under >= pictures * (0.975 - 4.5 * std::sqrt(0.975 * 0.025 / pictures)));
        if (side > 3) CHECK(inside <= pictures * (0.98 + 4.5 * std::sqrt(0.98 * 0.02 / pictures)));
    }
}

TEST_CASE("Error estimate: light that most samples miss leaves no estimate, or an interval with room for it",
          "[render][estimate]") {
    // The edge of a lamp, which fills any part of its pixels, between black ones and lit ones: those that it fills
    // little are mostly missed by 16 samples.
    Random random(3);
    const double lamp = 40;
    int room = 0;
    for (int picture = 0; picture < 50; ++picture) {
        Film film(60, 60);
        double truth = 0;
        for (int y = 0; y < 60; ++y)
            for (int x = 0; x < 60; ++x) {
                const double part = x % 3 == 0 ? 0 : x % 3 == 1 ? random.uniform() : 1;
                for (int i = 0; i < 16; ++i) film.add(x, y, grey_of(random.uniform() < part ? lamp : 0));
                truth += square(film.mean(x, y).r - part * lamp) / (square(part * lamp) + kDark) / 3600;
            }
        const ErrorEstimate e = estimate_error(film);
        REQUIRE(e.reason.empty());
        room += e.ci95_high >= truth;
    }
    CHECK(room >= 45);
    // Of a lamp brighter by a thousand it is not known what its neighbours miss.
    Film bright(60, 60);
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 60; ++x)
            for (int i = 0; i < 8; ++i)
                bright.add(x, y, grey_of(x % 3 == 2 || (x % 3 == 1 && random.uniform() < 0.05) ? 1e5 : 0));
    CHECK_FALSE(estimate_error(bright).reason.empty());
    CHECK(std::isnan(estimate_error(bright).ci95_high));
}

TEST_CASE("Error estimate: of 8 samples there is none where pixels unlike those around are mostly noise",
          "[render][estimate]") {
    // A third of the pixels is as dark as what relMSE adds, so that nothing is thought missing in them.
    const auto one_in_8 = [](int samples) {
        Film film(60, 60);
        for (int y = 0; y < 60; ++y)
            for (int x = 0; x < 60; ++x)
                for (int i = 0; i < samples; ++i)
                    film.add(x, y, grey_of(x % 3 == 0 ? 0 : x % 3 == 1 ? (i % 8 == 0 ? 0.79 : 0) : 1));
        return film;
    };
    CHECK_FALSE(estimate_error(one_in_8(8)).reason.empty());
    CHECK(estimate_error(one_in_8(16)).reason.empty());
}

TEST_CASE("Error estimate: the pixels' own errors have the estimate as their mean", "[render][estimate]") {
    Random random(5);
    for (const double lamp : {0.0, 100.0}) {  // beside a lamp the surround decides
        Film film(7, 5);
        for (int y = 0; y < 5; ++y)
            for (int x = 0; x < 7; ++x)
                for (int i = 0; i < 8 + 4 * (x % 2); ++i)
                    film.add(x, y, {random.uniform(), random.uniform() + (x == 3 ? lamp : 0), random.uniform()});
        PixelMaps maps;
        const ErrorEstimate e = estimate_error(film, &maps);
        REQUIRE((maps.error.size() == 35 && maps.samples.size() == 35));
        double sum = 0;
        for (const float v : maps.error) sum += v;
        CHECK(sum / 35 == Approx(e.estimate).epsilon(1e-6));
        CHECK((maps.samples[0] == 8 && maps.samples[1] == 12 && maps.samples[7] == 8));
        CHECK(transport::check_error(film).estimate == e.estimate);
        CHECK(transport::check_error(film).ci95_high == e.ci95_high);
    }
}

TEST_CASE("Checks: they come in multiples of two, close to each other where the target may be near",
          "[render][estimate]") {
    CHECK(transport::next_check(0, kInfinity, 1) == 8);
    CHECK(transport::next_check(7, std::nan(""), 1) == 8);
    for (const double ratio : {0.5, 1.0, 1.01, 1.2, 1.5, 2.0, 100.0, double{kInfinity}, std::nan("")}) {
        CAPTURE(ratio);
        int last_milestone = 8;
        for (int samples = 8; samples < 200000;) {
            if (transport::is_milestone(samples)) last_milestone = samples;
            const int next = transport::next_check(samples, ratio, 1);
            CHECK(next % 2 == 0);
            CHECK(next >= samples + 2);
            CHECK(next <= std::max(samples * 1.25, samples + 2.0));
            // However fast the error falls, up to the square of the samples, the step ends at most 6.3 % too late.
            if (samples == last_milestone && samples >= 64 && ratio >= 1)
                CHECK(next <= samples * std::max(1.063, std::sqrt(ratio)));
            samples = next;
        }
    }
    CHECK(transport::next_check(std::numeric_limits<int>::max() - 7, 4, 1) > 0);
    CHECK(transport::next_check(std::numeric_limits<int>::max() - 7, 1, 1) > 0);
}

TEST_CASE("Checks: milestones are the same whatever the target, and what is checked depends on no other check",
          "[render][estimate]") {
    std::vector<int> milestones;
    for (int samples = 8; samples < 100000; samples = transport::next_check(samples, kInfinity, 1))
        milestones.push_back(samples);
    CHECK((milestones[0] == 8 && milestones[1] == 10));
    for (std::size_t i = 0; i + 1 < milestones.size(); ++i) {
        for (const double ratio : {0.5, 1.0, 3.0}) {
            int samples = milestones[i];
            while (samples < milestones[i + 1]) {
                CHECK(transport::is_milestone(samples) == (samples == milestones[i]));
                samples = transport::next_check(samples, ratio, 1);
            }
            CHECK(samples == milestones[i + 1]);
        }
        // From between two checks the next one is the same.
        const int next = transport::next_check(milestones[i], 1, 1);
        for (int samples = milestones[i]; samples < next; ++samples)
            CHECK(transport::next_check(samples, 1, 1) == next);
    }
}

TEST_CASE("Rounds: further than checks, but never beyond the target", "[render][estimate]") {
    for (const int samples : {8, 30, 1000})
        for (const double ratio : {1.01, 1.3, 4.0, 12.0}) {
            const int next = transport::next_round(samples, ratio, 1);
            CHECK(next % 2 == 0);
            CHECK(next >= samples + 2);
            CHECK(next <= std::max(samples + 2.0, samples * std::max(1.05, std::sqrt(ratio))));
        }
    CHECK(transport::next_round(100, 1e9, 1) == 400);
    CHECK(transport::next_round(100, kInfinity, 1) == 200);
}

TEST_CASE("Error estimate: the largest share of a sample is that of the pixel behind 99.9 % of the others",
          "[render][estimate]") {
    for (const double unit : {1.0, 0x1p-20}) {  // however dark the picture is
        Film film(100, 20);                     // 2000 pixels: the third largest counts
        int place = 0;
        for (const double bright : {8.0, 6.0, 4.0, 2.0}) {
            for (const double v : {bright, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0})
                film.add(7 * place + 3, 5 * place, {0, unit * v, 0});
            ++place;
        }
        for (int y = 0; y < 20; ++y)
            for (int x = 0; x < 100; ++x)
                while (film.samples(x, y) < 8) film.add(x, y, unit * Color{1, 1, 1});
        CHECK(estimate_error(film).max_sample_share == Approx(4.0 / 6).epsilon(1e-7));
    }
}

TEST_CASE("Error estimate: one pixel short of eight samples is enough for no estimate", "[render][estimate]") {
    Film film(4, 4);
    fill(film, {1, 1, 1, 0, 1, 1, 1, 1});
    CHECK(estimate_error(film).reason.empty());
    Film poor(4, 4);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x)
            for (int i = 0; i < (x == 2 && y == 3 ? 7 : 10); ++i) poor.add(x, y, {1, 1, 1});
    const ErrorEstimate e = estimate_error(poor);
    CHECK(e.reason == "fewer than 8 samples in a pixel");
    CHECK((std::isnan(e.estimate) && std::isnan(e.ci95_low) && std::isnan(e.ci95_high)));
    CHECK(e.max_sample_share == Approx(1.0 / 10).epsilon(1e-7));
}

TEST_CASE("Error estimate: of samples whose squares are no numbers there is none", "[render][estimate]") {
    Film film(3, 3);
    fill(film, {1e200, 1e100, 1, 0, 1, 1, 1, 1});
    CHECK_FALSE(estimate_error(film).reason.empty());
    CHECK(std::isnan(estimate_error(film).ci95_high));
}

}  // namespace limn::error_estimate_test
