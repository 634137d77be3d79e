// The numbers that drive a sample: which they are, and that no two of them are the same or go together.
#include "render/sampler.h"

#include <set>

#include "property.h"

namespace limn::sampler_test {

using namespace test;
using transport::Sampler;
using transport::Use;

namespace {

constexpr SamplerKind kKinds[] = {SamplerKind::sobol, SamplerKind::independent};

// The camera's five, three towards a light and three to scatter by at each of `vertices`.
std::vector<double> numbers(SamplerKind kind, std::uint64_t seed, std::uint64_t pixel, std::uint64_t sample,
                            int vertices = 1) {
    const Sampler sampler(seed, pixel, sample, kind);
    const auto camera = sampler.numbers_of(0);
    std::vector<double> values(camera.begin(), camera.end());
    for (int vertex = 1; vertex <= vertices; ++vertex)
        for (const Use use : {Use::light, Use::scattering}) {
            const auto r = sampler.numbers_of(Sampler::group_of(static_cast<std::uint32_t>(vertex), use));
            values.insert(values.end(), r.begin(), r.begin() + 3);
        }
    return values;
}

}  // namespace

TEST_CASE("Sampler: independent numbers of seed, pixel and sample 0 are the published first block of Philox4x64-10",
          "[render][sampler]") {
    // Random123's kat_vectors: counter and key 0.
    const std::uint64_t published[] = {0x16554d9eca36314c, 0xdb20fe9d672d0fdc, 0xd7e772cee186176b, 0x7e68b68aec7ba23b};
    const auto drawn = Sampler(0, 0, 0, SamplerKind::independent).numbers_of(0);
    for (std::size_t i = 0; i < 4; ++i) CHECK(drawn[i] == static_cast<double>(published[i] >> 11) * 0x1p-53);
}

TEST_CASE("Sampler: numbers lie between 0 and 1, 1 left out", "[render][sampler]") {
    holds([](std::uint64_t seed, std::uint64_t pixel, std::uint64_t sample, std::uint8_t vertex) {
        for (const SamplerKind kind : kKinds)
            for (const Use use : {Use::light, Use::scattering, Use::roulette, Use::segment, Use::flight})
                for (const double x : Sampler(seed, pixel, sample, kind).numbers_of(Sampler::group_of(vertex, use)))
                    RC_ASSERT(x >= 0 && x < 1);
    });
}

TEST_CASE("Sampler: numbers have bits beyond the 32 of a Sobol point", "[render][sampler]") {
    for (const SamplerKind kind : kKinds) {
        std::set<std::uint64_t> lowest;
        for (std::uint64_t i = 0; i < 1000; ++i)
            lowest.insert(static_cast<std::uint64_t>(Sampler(i, 0, 0, kind).numbers_of(0)[0] * 0x1p53) & 0xfff);
        // Of 4096 values 1000 draws leave out 4096 (1 - 1/4096)^1000 = 3208.5, with a standard deviation under 10.
        CHECK(lowest.size() > 887 - 50);
    }
}

TEST_CASE("Sampler: no number comes twice, in another dimension, sample, pixel or seed", "[render][sampler]") {
    // 53 random bits: 4000 of them meet by chance once in 1e9 cases.
    for (const SamplerKind kind : kKinds) {
        std::set<double> seen;
        std::size_t drawn = 0;
        const std::uint64_t large = std::uint64_t{1} << 40;
        for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{1}, large, ~std::uint64_t{0}})
            for (const std::uint64_t pixel : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{2}, large})
                for (const std::uint64_t sample :
                     {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{2}, std::uint64_t{4}, large}) {
                    const std::vector<double> values = numbers(kind, seed, pixel, sample, 7);
                    seen.insert(values.begin(), values.end());
                    drawn += values.size();
                }
        CHECK(seen.size() == drawn);
    }
}

TEST_CASE("Sampler: any two dimensions of a sample, and those of neighbours, are not correlated", "[render][sampler]") {
    constexpr int kPixels = 64, kSamples = 64, kCount = kPixels * kSamples, kDimensions = 11;
    const SamplerKind kind = GENERATE(SamplerKind::sobol, SamplerKind::independent);
    // Four samples side by side: this one, the next of the pixel, the next of its replicate, that of the next pixel.
    std::vector<std::vector<double>> columns(4 * kDimensions);
    for (std::uint64_t pixel = 0; pixel < kPixels; ++pixel)
        for (std::uint64_t sample = 0; sample < kSamples; ++sample) {
            std::size_t column = 0;
            for (const auto& [p, s] :
                 {std::pair{pixel, sample}, {pixel, sample + 1}, {pixel, sample + 2}, {pixel + 1, sample}})
                for (const double x : numbers(kind, 7, p, s)) columns[column++].push_back(x - 0.5);
        }
    // Of two independent uniform numbers the mean product has the standard deviation 1 / (12 sqrt(n)); 5 of them are
    // passed by chance once in 1800 runs of all 946 pairs. Points of one replicate keep away from each other: those are
    // left out.
    double largest = 0;
    for (std::size_t i = 0; i < columns.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            if (kind == SamplerKind::sobol && i / kDimensions == 2 && j / kDimensions == 0) continue;
            double sum = 0;
            for (std::size_t n = 0; n < kCount; ++n) sum += columns[i][n] * columns[j][n];
            largest = std::max(largest, std::abs(sum / kCount) * 12 * std::sqrt(double{kCount}));
        }
    CHECK(largest <= 5);
}

}  // namespace limn::sampler_test
