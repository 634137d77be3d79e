// Owen-scrambled Sobol points: against Boost's sequence, against the definition of a net, and by how fast sums
// converge.
#include "math/sobol-inl.h"

#include <boost/random/sobol.hpp>
#include <functional>
#include <set>

#include "catch.h"
#include "limn/math/surface.h"
#include "render/sampler.h"
#include "support/random_geometry.h"

namespace limn::sobol_test {

using namespace test;
using transport::Sampler;

namespace {

using sobol::HWY_NAMESPACE::scrambled_upward;

std::array<std::uint32_t, sobol::kDimensions> point(std::uint32_t index) {
    std::array<std::uint32_t, sobol::kDimensions> p;
    sobol::HWY_NAMESPACE::find_coordinates<sobol::kDimensions>(sobol::HWY_NAMESPACE::reversed(index), p.data());
    for (std::uint32_t& coordinate : p) coordinate = sobol::HWY_NAMESPACE::reversed(coordinate);
    return p;
}

// Number `sample` of the group that this vertex scatters by.
std::array<double, 5> numbers(std::uint64_t pixel, std::uint64_t sample) {
    return Sampler(17, pixel, sample).numbers_of(Sampler::group_of(1, transport::Use::scattering));
}

// Whether samples 2 first, 2 (first + 1) ... of a replicate have one in each of the boxes of 2^-a by 2^-b.
bool is_net(std::uint64_t pixel, std::uint64_t first, int log2_count, std::size_t i, std::size_t j) {
    for (int a = 0; a <= log2_count; ++a) {
        std::set<std::pair<int, int>> boxes;
        for (std::uint64_t n = 0; n < std::uint64_t{1} << log2_count; ++n) {
            const auto p = numbers(pixel, 2 * (first + n) + pixel % 2);
            boxes.insert({static_cast<int>(std::ldexp(p[i], a)), static_cast<int>(std::ldexp(p[j], log2_count - a))});
        }
        if (boxes.size() != std::size_t{1} << log2_count) return false;
    }
    return true;
}

// The variance of the mean of `samples` samples over pixels.
double variance_of_mean(std::uint64_t samples, SamplerKind kind, const std::function<double(const Random3&)>& f) {
    const int pixels = 400;
    double sum = 0, squares = 0;
    for (int pixel = 0; pixel < pixels; ++pixel) {
        double mean = 0;
        for (std::uint64_t i = 0; i < samples; ++i) {
            const auto r = Sampler(3, static_cast<std::uint64_t>(pixel), i, kind).numbers_of(0);
            mean += f({r[0], r[1], r[2]}) / static_cast<double>(samples);
        }
        sum += mean, squares += mean * mean;
    }
    return squares / pixels - sum / pixels * sum / pixels;
}

}  // namespace

TEST_CASE("Sobol: the points before scrambling are Boost's", "[render][sampler]") {
    // Boost counts in Gray code and leaves out the origin.
    boost::random::sobol_engine<std::uint32_t, 32> boost(sobol::kDimensions);
    int wrong = 0;
    for (std::uint32_t n = 1; n < 70'000; ++n) {
        const auto ours = point(n ^ (n >> 1));
        for (std::size_t d = 0; d < sobol::kDimensions; ++d) wrong += ours[d] != boost();
    }
    CHECK(wrong == 0);
    CHECK(point(0) == std::array<std::uint32_t, sobol::kDimensions>{});
    const std::uint32_t far = (1U << 24) - 5;
    boost.seed(far - 1);
    const auto ours = point(far ^ (far >> 1));
    for (std::size_t d = 0; d < sobol::kDimensions; ++d) CHECK(ours[d] == boost());
}

TEST_CASE("Sobol: any 2^k points of a replicate from a multiple of 2^k on have one in each box of 2^-a by 2^(a-k)",
          "[render][sampler]") {
    for (const std::uint64_t pixel : {0u, 1u, 6u, 1023u})
        for (const std::uint64_t first : {0u, 64u, 640u, 1u << 20, (1u << 24) - 64, 1u << 24}) {
            CAPTURE(pixel, first);
            CHECK(is_net(pixel, first, 6, 0, 1));
            CHECK(is_net(pixel, first, 3, 0, 1));
        }
    CHECK(is_net(2, 0, 10, 0, 1));
    CHECK_FALSE(is_net(2, 1, 6, 0, 1));
}

TEST_CASE("Sobol: in each of five dimensions 2^k points have one in each of 2^k parts", "[render][sampler]") {
    for (const std::uint64_t first : {0u, 256u})
        for (std::size_t d = 0; d < sobol::kDimensions; ++d) {
            std::set<int> parts;
            for (std::uint64_t n = 0; n < 256; ++n)
                parts.insert(static_cast<int>(256 * numbers(9, 2 * (first + n) + 1)[d]));
            CHECK(parts.size() == 256);
        }
}

TEST_CASE("Sobol: scrambling turns each bit half of the time, whatever the seed does to the others",
          "[render][sampler]") {
    Random random(8);
    const int seeds = 20'000;
    const double bound = 5 / (2 * std::sqrt(double{seeds}));  // standard errors of a share of one half
    for (const std::uint32_t x : {0u, 1u, 0x80000000u, 0x12345678u, ~0u}) {
        std::array<int, 32> turned{};
        std::array<std::array<int, 32>, 32> together{};
        for (int i = 0; i < seeds; ++i) {
            const std::uint32_t flips = scrambled_upward(x, static_cast<std::uint32_t>(random.index(1ULL << 32))) ^ x;
            for (std::size_t b = 0; b < 32; ++b) {
                turned[b] += (flips >> b) & 1;
                for (std::size_t c = 0; c < b; ++c) together[b][c] += ((flips >> b) ^ (flips >> c)) & 1;
            }
        }
        double worst = 0;
        for (std::size_t b = 0; b < 32; ++b) {
            worst = std::max(worst, std::abs(turned[b] / double{seeds} - 0.5));
            for (std::size_t c = 0; c < b; ++c) worst = std::max(worst, std::abs(together[b][c] / double{seeds} - 0.5));
        }
        CAPTURE(x);
        CHECK(worst <= bound);
    }
}

TEST_CASE("Sobol: a bit is turned by the bits below it alone", "[render][sampler]") {
    Random random(9);
    for (int i = 0; i < 1000; ++i) {
        const auto x = static_cast<std::uint32_t>(random.index(1ULL << 32)),
                   seed = static_cast<std::uint32_t>(random.index(1ULL << 32));
        const auto bit = static_cast<unsigned>(random.index(32));
        const std::uint32_t change = scrambled_upward(x, seed) ^ scrambled_upward(x ^ (1U << bit), seed);
        CHECK(std::countr_zero(change) == static_cast<int>(bit));
    }
}

TEST_CASE(
    "Sobol: the mean of a smooth function gets better with the cube of the samples, of an edge with their "
    "1.5th power, where independent samples need as many more",
    "[render][sampler]") {
    const auto smooth = [](const Random3& r) { return std::exp(r.x) * std::cos(r.y); };
    const auto edge = [](const Random3& r) { return r.x + 0.7 * r.y < 0.8 ? 1.0 : 0.0; };
    const auto gain = [](SamplerKind kind, const auto& f) {
        return variance_of_mean(32, kind, f) / variance_of_mean(512, kind, f);
    };
    // 16 times the samples: 16^3, 16^1.5, 16. The quotient of two variances from 400 means has a relative standard
    // error of 2 / sqrt(400).
    const double noise = 4.5 * 2 / std::sqrt(400.0);
    CHECK(gain(SamplerKind::sobol, smooth) >= std::pow(16, 3) * (1 - noise));
    CHECK(gain(SamplerKind::sobol, edge) >= std::pow(16, 1.5) * (1 - noise));
    CHECK(std::abs(gain(SamplerKind::independent, smooth) / 16 - 1) <= noise);
    CHECK(std::abs(gain(SamplerKind::independent, edge) / 16 - 1) <= noise);
}

TEST_CASE("Sobol: at no number of samples is the mean worse than that of independent ones", "[render][sampler]") {
    const std::function<double(const Random3&)> functions[] = {
        [](const Random3& r) { return r.x * r.y * r.z; },
        [](const Random3& r) { return r.x * r.x + r.y * r.y + r.z * r.z < 1 ? 1.0 : 0.0; },
        [](const Random3& r) { return r.x < 0.1 && r.z > 0.8 ? r.y : 0.0; },
        [](const Random3& r) { return std::sin(40 * r.x) * std::sin(30 * r.y + 1); },
    };
    for (std::size_t f = 0; f < std::size(functions); ++f)
        for (const std::uint64_t samples : {1u, 4u, 7u, 24u, 63u, 200u}) {
            CAPTURE(f, samples);
            CHECK(variance_of_mean(samples, SamplerKind::sobol, functions[f]) <=
                  variance_of_mean(samples, SamplerKind::independent, functions[f]) * (1 + 4.5 * 2 / std::sqrt(400.0)));
        }
}

}  // namespace limn::sobol_test
