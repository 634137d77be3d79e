// The error estimate, on films small enough to work out by hand and on others whose truth is known.
#include "render/error_estimate.h"

#include <boost/math/distributions/fisher_f.hpp>

#include "property.h"
#include "support/random_geometry.h"

using namespace limn;
using namespace limn::test;
using tracing::estimate_error;
using tracing::Film;

namespace {

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

// One channel's variance of the mean over (what the other replicates say)^2 + 0.01, averaged over who is who; and over
// the mean of all.
std::pair<double, double> by_hand(const std::vector<double>& samples) {
    const double n = static_cast<double>(samples.size());
    double mean = 0;
    std::array<double, 4> means{}, counts{};
    for (std::size_t i = 0; i < samples.size(); ++i) {
        means[i % 4] += samples[i];
        ++counts[i % 4];
        mean += samples[i] / n;
    }
    for (std::size_t r = 0; r < 4; ++r) means[r] /= counts[r];
    double crossed = 0, between = 0;
    for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 0; b < a; ++b) {
            std::vector<double> others;
            for (std::size_t r = 0; r < 4; ++r)
                if (r != a && r != b) others.push_back(means[r]);
            const double middle = (others[0] + others[1]) / 2, off = (others[0] - others[1]) / 2;
            const double per_sample = square(means[a] - means[b]) / (1 / counts[a] + 1 / counts[b]);
            const double convex = std::max(0.0, 3 * middle * middle - kDark) / (middle * middle + kDark);
            between += per_sample / n / 6;
            crossed += per_sample / n / (middle * middle + kDark + convex * off * off) / 6;
        }
    return {crossed, between / (mean * mean + kDark)};
}

}  // namespace

TEST_CASE("Error estimate: one pixel's is the variance between four replicates over what the others show",
          "[render][estimate]") {
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
        double crossed = 0, plain = 0;
        for (const std::vector<double>& v : values) {
            const auto [c, p] = by_hand(v);
            crossed += c / 3, plain += p / 3;
        }
        const ErrorEstimate e = estimate_error(film);
        RC_ASSERT(std::abs(e.estimate - std::max(crossed, plain)) <= 1e-12 * e.estimate);
        RC_ASSERT(e.reason.empty());
    });
}

// Replicates of 2 samples each have the means 1, 2, 3, 4: variance of the mean 2 (2.25 + 0.25 + 0.25 + 2.25) / (3 * 8).
TEST_CASE("Error estimate: means of 1, 2, 3, 4 are off by 5/12, squared", "[render][estimate]") {
    Film film(1, 1);
    for (const double value : {101, 102, 103, 104, 101, 102, 103, 104}) film.add(0, 0, grey_of(value));
    CHECK(film.image().at(0, 0) == grey_of(102.5));
    CHECK(estimate_error(film).estimate == Approx(10.0 / 24 / (102.5 * 102.5)).epsilon(1e-3));
}

TEST_CASE("Error estimate: over many pixels it is the mean squared error, also for uneven replicates",
          "[render][estimate]") {
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
        CHECK(std::abs(estimate_error(film).estimate / truth - 1) <= 4.5 * std::sqrt(2.0 / 3 / (64 * 64)) + 1e-3);
    }
}

TEST_CASE(
    "Error estimate: a bright pixel among black ones counts against the 5 x 5 around it, as far as there are "
    "pixels",
    "[render][estimate]") {
    const struct {
        int x, y, around;
    } places[] = {{8, 8, 25},  {2, 2, 25}, {1, 2, 20}, {1, 1, 16},  {0, 0, 9},
                  {15, 15, 9}, {15, 0, 9}, {0, 7, 15}, {13, 14, 20}};
    for (const auto& p : places) {
        CAPTURE(p.x, p.y);
        const Film film = with_one_pixel(p.x, p.y, {10.5, 10, 10, 9.5}, 0);  // variance of the mean .5 / 12
        const double relative = 0.5 / 12 / (square(10.0 / p.around) + kDark);
        CHECK(estimate_error(film).estimate == Approx(relative / 256).epsilon(1e-12));
    }
}

TEST_CASE("Error estimate: a dark pixel among bright ones counts against itself", "[render][estimate]") {
    const Film film = with_one_pixel(8, 8, {0, 0, 0, 0.4}, 1);
    // Three of six pairs hold the .4: variance .02, and black is what the others show.
    CHECK(estimate_error(film).estimate == Approx(0.02 / kDark / 2 / 256).epsilon(1e-12));
}

TEST_CASE("Error estimate: rare bright samples do not hide their own error", "[render][estimate]") {
    // Four fifths of a pixel's light comes in flashes, of which a replicate has 0.16 / 4 e: for a relMSE of e.
    for (const double error : {1e-1, 1e-2, 1e-3}) {
        Random random(31);
        const int side = 120;
        Film film(side, side);
        const double flashes = 0.64 / (4 * error);
        double truth = 0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                for (int r = 0; r < 4; ++r) {
                    double count = 0;  // Poisson, by its definition: arrivals until time `flashes`
                    for (double t = -std::log1p(-random.uniform()); t < flashes; t -= std::log1p(-random.uniform()))
                        ++count;
                    film.add(x, y, grey_of(0.2 + 0.8 * count / flashes));
                }
                truth += square(film.mean(x, y).r - 1) / (1 + kDark) / (side * side);
            }
        CAPTURE(error);
        // Truth and estimate together have a relative variance of 8/3 over the pixels.
        CHECK(estimate_error(film).estimate / truth >= 1 - 4.5 * std::sqrt(8.0 / 3) / side);
        if (error < 0.05)
            CHECK(estimate_error(film).estimate / truth <= 1 + 4.5 * std::sqrt(8.0 / 3) / side + 3 * error);
    }
}

TEST_CASE("Error estimate: the factors of n equal pixels are the quantiles of F with n and 3 n degrees",
          "[render][estimate]") {
    // Paulson's approximation errs most where there is one value alone, on the safe side.
    const struct {
        double values, tolerance;
    } rows[] = {{1, 0.12}, {2, 0.03}, {5, 0.01}, {30, 2e-3}, {1000, 1e-4}, {1e6, 1e-6}};
    for (const auto& row : rows) {
        CAPTURE(row.values);
        const boost::math::fisher_f f(row.values, 3 * row.values);
        const tracing::ErrorFactors factors = tracing::error_factors(row.values);
        CHECK(factors.high == Approx(boost::math::quantile(f, 0.975)).epsilon(row.tolerance));
        CHECK(factors.high >= boost::math::quantile(f, 0.975) * (1 - 1e-3));
        if (row.values > 1) CHECK(std::abs(factors.low - boost::math::quantile(f, 0.025)) <= 2 * row.tolerance);
    }
}

TEST_CASE("Error estimate: one noisy pixel is worth one value, a hundred with equal noise a hundred",
          "[render][estimate]") {
    const Film one = with_one_pixel(8, 8, {1.1, 1, 1, 0.9}, 1);
    const ErrorEstimate e = estimate_error(one);
    CHECK(e.ci95_high == Approx(tracing::error_factors(1).high * e.estimate).epsilon(1e-12));
    CHECK(e.ci95_low == Approx(tracing::error_factors(1).low * e.estimate).margin(1e-12));
    Random random(12);
    Film equal(100, 100);
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 100; ++x)
            for (int i = 0; i < 4; ++i) equal.add(x, y, grey_of(1000 + normal(random)));
    const ErrorEstimate of_equal = estimate_error(equal);
    // The sum of 10^4 products, each of relative variance 8 at most, is known to 2.8 %, and counts as 3 % larger: half
    // of that goes into the width of the interval. No more values count than there are pixels.
    const double width = tracing::error_factors(1e4).high - 1;
    CHECK((of_equal.ci95_high / of_equal.estimate - 1) / width <= 1.015 + 4.5 * 0.014);
    CHECK((of_equal.ci95_high / of_equal.estimate - 1) / width >= 1 - 1e-9);
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
                    for (int s = 0; s < 4; ++s) film.add(x, y, grey_of(1000 + noise * normal(random)));
                    truth += square(film.mean(x, y).r - 1000) / (1e6 + kDark) / (side * side);
                }
            const ErrorEstimate e = estimate_error(film);
            inside += truth >= e.ci95_low && truth <= e.ci95_high;
            under += truth <= e.ci95_high;
        }
        CAPTURE(side, inside, under);
        // 4.5 standard errors of a share; above, the approximations may err on the safe side.
        CHECK(inside >= pictures * (0.95 - 4.5 * std::sqrt(0.95 * 0.05 / pictures)));
        CHECK(under >= pictures * (0.975 - 4.5 * std::sqrt(0.975 * 0.025 / pictures)));
        if (side > 3) CHECK(inside <= pictures * (0.97 + 4.5 * std::sqrt(0.97 * 0.03 / pictures)));
    }
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
        CHECK(tracing::check_error(film).estimate == e.estimate);
        CHECK(tracing::check_error(film).ci95_high == e.ci95_high);
    }
}

TEST_CASE("Error estimate: checks come in multiples of four, close to each other near the target and never beyond it",
          "[render][estimate]") {
    for (const int samples : {64, 100, 1000, 123456}) {
        for (const double ratio : {1.0, 1.01, 1.2, 2.0, 100.0, double{kInfinity}}) {
            const int next = tracing::next_check(samples, ratio, 1);
            CHECK(next % 4 == 0);
            CHECK(next >= samples + 4);
            CHECK(next <= std::max(samples * 1.25, samples + 4.0));
            // However fast the error falls, up to the square of the samples, the step ends at most 6.3 % too late.
            CHECK(next <= samples * std::max(1.063, std::sqrt(ratio)));
        }
    }
    CHECK(tracing::next_check(64, 4, 1) == 80);
    CHECK(tracing::next_check(1000, 1.44, 1) == 1200);
    CHECK(tracing::next_check(std::numeric_limits<int>::max() - 7, 4, 1) > 0);
}

TEST_CASE("Error estimate: the largest share of a sample is that of the pixel behind 99.9 % of the others",
          "[render][estimate]") {
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
        CHECK(estimate_error(film).max_sample_share == Approx(4.0 / 6).epsilon(1e-7));
    }
}

TEST_CASE("Error estimate: one pixel short of a sample in each replicate is enough for no estimate",
          "[render][estimate]") {
    Film film(4, 4);
    fill(film, {1, 1, 1, 0});
    CHECK(estimate_error(film).reason.empty());
    Film poor(4, 4);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x)
            for (int i = 0; i < (x == 2 && y == 3 ? 3 : 6); ++i) poor.add(x, y, {1, 1, 1});
    const ErrorEstimate e = estimate_error(poor);
    CHECK_FALSE(e.reason.empty());
    CHECK((std::isnan(e.estimate) && std::isnan(e.ci95_low) && std::isnan(e.ci95_high)));
    CHECK(e.max_sample_share == Approx(1.0 / 6).epsilon(1e-7));
}
