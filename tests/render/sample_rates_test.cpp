// Adaptive sampling: where samples go, and that the picture stays what it was.
#include "render/sample_rates.h"

#include <cstdlib>
#include <numeric>

#include "catch.h"
#include "limn/image/compare.h"
#include "limn/render/film.h"
#include "support/pictures.h"
#include "support/random_geometry.h"

namespace limn::sample_rates_test {

using namespace test;

namespace {

// kFirstPass samples a pixel, whose standard deviation is `noise(x, y)`.
template <class Noise>
Film piloted(int width, int height, const Noise& noise, std::uint64_t seed = 1) {
    Film film(width, height);
    Random random(seed);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int i = 0; i < SamplePlan::kFirstPass; ++i) {
                const double value = 1 + noise(x, y) * std::sqrt(3.0) * (2 * random.uniform() - 1);
                film.add(x, y, {value, value, value});
            }
    return film;
}

// Row by row.
std::vector<float> rates_of(const Film& film) {
    const std::vector<float> rates = transport::sample_rates(film);
    std::vector<float> rows;
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) rows.push_back(rates[film.place(x, y)]);
    return rows;
}

double mean(const std::vector<float>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// A floor and a ball under a black sky, lit by a lamp above the picture: noise in its lower half, none in the other.
const Camera kEye = camera_at({0, 1, 6}, {0, 1, 0}, 40);
CompiledScene lit_floor() {
    return compile_with(sky(0), {quad({-9, 0, -9}, {0, 0, 18}, {18, 0, 0}, grey(0.7)),
                                 sphere({0, 0.5, 0}, 0.5, grey(0.3)), sphere({0, 5, -1}, 0.3, lamp(60))});
}

RenderSettings adaptive(int side, int samples) {
    RenderSettings s = square(side, 1, 4);
    s.error = 1e-9;
    s.max_samples_per_pixel = samples;
    return s;
}

}  // namespace

TEST_CASE("Sample rates: pixels of equal noise get equal rates, and so do all without noise", "[render][adaptive]") {
    for (const float rate : rates_of(piloted(9, 7, [](int, int) { return 0.0; }))) CHECK(rate == 1);
    const std::vector<float> rates = rates_of(piloted(64, 64, [](int, int) { return 0.3; }));
    CHECK(std::abs(mean(rates) - 1) < 1e-6);
    // 3 degrees of freedom in each of 24 pixels: a tenth in the deviation, somewhat more at the borders.
    for (const float rate : rates) CHECK((rate > 0.5f && rate < 1.6f));
    CHECK(rates_of(piloted(1, 1, [](int, int) { return 0.3; })) == std::vector<float>{1});
}

TEST_CASE("Sample rates: they grow as the standard deviation, and none falls under a quarter", "[render][adaptive]") {
    const std::vector<float> rates = rates_of(piloted(96, 32, [](int x, int) {
        return x < 32 ? 0.0 : x < 64 ? 0.2 : 0.6;
    }));
    CHECK(std::abs(mean(rates) - 1) < 1e-6);
    double sums[3] = {};
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 96; ++x) {
            const double rate = rates[static_cast<std::size_t>(96 * y + x)];
            CHECK(rate >= transport::kSmallestRate);
            if (x % 32 >= 3 && x % 32 < 29) sums[x / 32] += rate / (26 * 32);
        }
    CHECK(std::abs(sums[0] - 0.25) < 1e-9);
    CHECK(std::abs((sums[2] - 0.25) / (sums[1] - 0.25) - 3) < 0.3);
}

TEST_CASE("Sample rates: at edges without noise pixels get more, by as much as they may have missed",
          "[render][adaptive]") {
    // A lamp of 4 beside black, in whose edge no sample has fallen; a noise of 1 % far from it.
    Film film(48, 16);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 48; ++x)
            for (int i = 0; i < SamplePlan::kFirstPass; ++i) {
                const double value = x < 8 ? 4 : x < 24 ? 0 : i % 2 == 0 ? 0.99 : 1.01;
                film.add(x, y, {value, value, value});
            }
    const std::vector<float> rates = rates_of(film);
    const auto rate = [&](int x) { return rates[static_cast<std::size_t>(48 * 8 + x)]; };
    for (const int x : {7, 8}) CHECK(rate(x) > 20 * rate(36));
    CHECK(rate(2) == transport::kSmallestRate);
    CHECK(rate(14) == transport::kSmallestRate);
}

TEST_CASE("Sample rates: a pixel's own samples say nothing about its rate", "[render][adaptive]") {
    const auto even = [](int, int) { return 0.15; };
    const std::vector<float> before = rates_of(piloted(15, 15, even));
    Film film = piloted(15, 15, even);
    for (int i = 0; i < SamplePlan::kFirstPass; ++i) film.add(7, 7, Color{1, 1, 1} * (i == 0 ? 1e4 : 1));
    const std::vector<float> after = rates_of(film);
    // All of the others share one factor, that of the mean, which the pixels around it have moved.
    const auto noise = [](float rate) { return rate - transport::kSmallestRate; };
    const double factor = noise(after[0]) / noise(before[0]);
    CHECK(factor < 0.9);
    CHECK(std::abs(noise(after[7 * 15 + 7]) / noise(before[7 * 15 + 7]) / factor - 1) < 1e-4);
    CHECK(noise(after[7 * 15 + 8]) / noise(before[7 * 15 + 8]) / factor > 2);
}

TEST_CASE("Sample plans: the mean is what was asked for, and no pixel loses samples", "[render][adaptive]") {
    const int width = GENERATE(13, 130, 1300), height = 90;
    const bool exact = GENERATE(false, true);
    SamplePlan plan;
    const Film film = piloted(width, height, [](int x, int) { return x < 6 ? 0.01 : 0.5; });
    plan.rates = transport::sample_rates(film);
    std::vector<std::uint32_t> before(film.pixels(), SamplePlan::kFirstPass);
    for (const int samples : {8, 9, 12, 17, 20, 64, 65, 131, 1000, 100000}) {
        CAPTURE(samples);
        plan.samples = samples;
        plan.scale = transport::scale_for(film, plan.rates, samples, exact);
        double sum = 0;
        bool grows = true, is_even = true, is_near = true;
        for (std::size_t i = 0; i < before.size(); ++i) {
            const auto columns = static_cast<std::size_t>(width);
            const int x = static_cast<int>(i % columns), y = static_cast<int>(i / columns);
            const std::uint32_t wanted = plan.wanted(x, y, film.place(x, y));
            grows = grows && wanted >= before[i];
            is_even = is_even && wanted % 2 == 0;
            is_near = is_near && std::abs(wanted - std::max(8.0, plan.scale * plan.rates[film.place(x, y)])) <= 2;
            before[i] = wanted;
            sum += wanted;
        }
        CHECK((grows && is_even && is_near));
        const double pixels = static_cast<double>(before.size());
        CHECK(sum <= pixels * samples);
        CHECK(sum >= pixels * samples - (exact ? 1 : std::max(1.0, pixels / 65536)));
    }
}

TEST_CASE("Adaptive sampling: the same picture on any number of threads, more samples where it is noisy",
          "[render][adaptive]") {
    RenderSettings settings = adaptive(40, 96);
    settings.threads = 1;
    const CompiledScene scene = lit_floor();
    const RenderResult once = render(scene, kEye, settings);
    CHECK(once.report.samples_per_pixel == 96);
    const auto [fewest, most] = std::minmax_element(once.maps.samples.begin(), once.maps.samples.end());
    CHECK((*fewest >= 22 && *fewest <= 26));
    CHECK(*most > 120);
    settings.threads = 3;
    CHECK(render(scene, kEye, settings).image == once.image);
    settings.uniform = true;
    const RenderResult uniform = render(scene, kEye, settings);
    for (const float samples : uniform.maps.samples) CHECK(samples == 96);
    CHECK(once.error.estimate < 0.8 * uniform.error.estimate);
}

TEST_CASE("Adaptive sampling: neither the picture nor the estimate of its error is biased", "[render][adaptive]") {
    const int kSeeds = std::getenv("LIMN_FULL") ? 1000 : 200, kSide = 12;
    const CompiledScene scene = lit_floor();
    RenderSettings settings = square(kSide, 1 << 16, 4);
    settings.seed = 1'000'000;
    const Image reference = render(scene, kEye, settings).image;
    // Pixels as they are: block means would hide what goes wrong at edges.
    std::vector<double> sums(static_cast<std::size_t>(kSide * kSide)), squares(sums.size());
    double error = 0, estimate = 0;
    for (int seed = 0; seed < kSeeds; ++seed) {
        settings = adaptive(kSide, 40);
        settings.seed = static_cast<std::uint64_t>(seed);
        const RenderResult r = render(scene, kEye, settings);
        error += compare_images(r.image, reference).relative_mse / kSeeds;
        estimate += r.error.estimate / kSeeds;
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                const double difference = luminance(r.image.at(x, y)) - luminance(reference.at(x, y));
                const auto i = static_cast<std::size_t>(kSide * y + x);
                sums[i] += difference, squares[i] += difference * difference;
            }
    }
    double chi_squared = 0, sum_z = 0;
    int count = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        if (!(squares[i] > 0)) continue;
        const double z = sums[i] / std::sqrt(squares[i]);
        chi_squared += z * z, sum_z += z, ++count;
    }
    INFO("rms z " << std::sqrt(chi_squared / count) << ", mean z " << sum_z / count << ", error " << error
                  << ", estimate " << estimate);
    CHECK(count > kSide * kSide / 3);
    CHECK(std::sqrt(chi_squared / count) < 1.25);
    CHECK(std::abs(sum_z) < 4 * std::sqrt(count));
    CHECK((estimate > 0.9 * error && estimate < 1.1 * error));
}

}  // namespace limn::sample_rates_test
