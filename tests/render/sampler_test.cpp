// The numbers that drive a sample: which they are, and that no two of them are the same or go together.
#include "render/sampler.h"

#include <set>

#include "property.h"

using namespace limn;
using namespace limn::test;
using tracing::Sampler;

namespace {

constexpr int kDimensions = 10;  // three blocks of the generator

std::vector<double> numbers(std::uint64_t seed, std::uint64_t pixel, std::uint64_t sample, int count = kDimensions) {
    Sampler sampler(seed, pixel, sample);
    std::vector<double> values;
    for (int i = 0; i < count; ++i) values.push_back(sampler.next());
    return values;
}

}  // namespace

TEST_CASE("Sampler: seed, pixel and sample 0 give the published first block of Philox4x64-10", "[render][sampler]") {
    // Random123's kat_vectors: counter and key 0.
    const std::uint64_t published[] = {0x16554d9eca36314c, 0xdb20fe9d672d0fdc, 0xd7e772cee186176b, 0x7e68b68aec7ba23b};
    Sampler sampler(0, 0, 0);
    for (const std::uint64_t word : published) CHECK(sampler.next() == static_cast<double>(word >> 11) * 0x1p-53);
}

TEST_CASE("Sampler: numbers lie between 0 and 1, 1 left out, and pairs and triples are the next two and three",
          "[render][sampler]") {
    holds([](std::uint64_t seed, std::uint64_t pixel, std::uint64_t sample) {
        const std::vector<double> plain = numbers(seed, pixel, sample);
        for (const double x : plain) RC_ASSERT(x >= 0 && x < 1);
        Sampler sampler(seed, pixel, sample);
        const Uv pair = sampler.next_2d();
        const Random3 triple = sampler.next_3d();
        const double single = sampler.next();
        RC_ASSERT((std::vector{pair.u, pair.v, triple.x, triple.y, triple.z, single}) ==
                  std::vector(plain.begin(), plain.begin() + 6));
    });
}

TEST_CASE("Sampler: no number comes twice, in another dimension, sample, pixel or seed", "[render][sampler]") {
    // 53 random bits: 2000 of them meet by chance once in 4e9 cases.
    std::set<double> seen;
    std::size_t drawn = 0;
    const std::uint64_t large = std::uint64_t{1} << 40;
    for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{1}, large, ~std::uint64_t{0}})
        for (const std::uint64_t pixel : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{2}, large})
            for (const std::uint64_t sample : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{2}, large}) {
                const std::vector<double> values = numbers(seed, pixel, sample, 30);
                seen.insert(values.begin(), values.end());
                drawn += values.size();
            }
    CHECK(seen.size() == drawn);
}

TEST_CASE("Sampler: any two dimensions of a sample, and those of neighbours, are not correlated", "[render][sampler]") {
    constexpr int kPixels = 64, kSamples = 64, kCount = kPixels * kSamples;
    // Three samples side by side: this one, the next of the pixel, the same of the next pixel.
    std::vector<std::vector<double>> columns(3 * kDimensions);
    for (std::uint64_t pixel = 0; pixel < kPixels; ++pixel)
        for (std::uint64_t sample = 0; sample < kSamples; ++sample) {
            std::size_t column = 0;
            for (const auto& [p, s] : {std::pair{pixel, sample}, {pixel, sample + 1}, {pixel + 1, sample}})
                for (const double x : numbers(7, p, s)) columns[column++].push_back(x - 0.5);
        }
    // Of two independent uniform numbers the mean product has the standard deviation 1 / (12 sqrt(n)); 5 of them are
    // passed by chance once in 4000 runs of all 435 pairs.
    double largest = 0;
    for (std::size_t i = 0; i < columns.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            double sum = 0;
            for (std::size_t n = 0; n < kCount; ++n) sum += columns[i][n] * columns[j][n];
            largest = std::max(largest, std::abs(sum / kCount) * 12 * std::sqrt(double{kCount}));
        }
    CHECK(largest <= 5);
}
