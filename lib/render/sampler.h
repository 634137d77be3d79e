// Random numbers that depend on nothing but (seed, pixel, sample, dimension).
#pragma once

#include <Random123/philox.h>

#include <array>
#include <cstdint>

#include "limn/render/film.h"
#include "limn/render/settings.h"
#include "sampling/sobol.h"

namespace limn::transport {

// What a vertex of a path draws numbers for.
enum class Use : std::uint32_t { light, scattering, roulette, segment, flight, holes };

// The numbers of one sample, drawn in groups. Within a group of up to five dimensions the samples of a pixel form a
// Sobol sequence; the groups are independently scrambled and shuffled (Burley, Practical hash-based Owen scrambling,
// 2020), so that there is no end of them. A number that is drawn for the same use at the same vertex is in the same
// group in all samples of a pixel, whatever else they draw.
//
// Each of the film's replicates has a randomisation of its own: sample i is point i / 2 of replicate i mod 2.
//
// `independent` numbers: Philox4x64-10, a block for each four of a group. Salmon et al., Parallel random numbers: as
// easy as 1, 2, 3, 2011.
class Sampler {
public:
    Sampler(std::uint64_t seed, std::uint64_t pixel, std::uint64_t sample, SamplerKind kind = SamplerKind::sobol)
        : kind_(kind), seed_(seed), pixel_(pixel), sample_(sample) {
        if (kind_ == SamplerKind::independent) return;
        const std::uint64_t point = sample / Film::kReplicates, replicate = sample % Film::kReplicates;
        // A sequence ends after 2^24 points; what follows is another randomisation.
        const std::uint64_t sequence = (point >> sobol::kIndexBits) * Film::kReplicates + replicate;
        base_ = sobol::base_of(seed, pixel, sequence);
        index_ = sobol::index_of(static_cast<std::uint32_t>(point));
    }

    // What a batch of paths needs for sobol::draw; not where numbers are independent.
    SamplerKind kind() const { return kind_; }
    std::uint64_t base() const { return base_; }
    std::uint32_t index() const { return index_; }

    // The group for a use at a vertex. The camera's is 0, and the first vertex 1.
    static std::uint32_t group_of(std::uint32_t vertex, Use use) {
        return vertex * kGroupsOfVertex + static_cast<std::uint32_t>(use) * kGroupsOfUse;
    }
    // Its numbers, in [0, 1).
    std::array<double, 5> numbers_of(std::uint32_t group) const {
        if (kind_ == SamplerKind::sobol) return sobol::numbers_of(base_, index_, group);
        std::array<double, 5> numbers{};
        for (std::size_t first = 0; first < numbers.size(); first += 4) {
            const auto block = r123::Philox4x64{}({{pixel_, sample_, group, first / 4}}, {{seed_, 0}});
            for (std::size_t i = first; i < numbers.size() && i < first + 4; ++i)
                numbers[i] = static_cast<double>(block[i - first] >> 11) * 0x1p-53;
        }
        return numbers;
    }

private:
    // Room for 256 uses at a vertex, of 16 groups each: more than there are, so that new ones change no other.
    static constexpr std::uint32_t kGroupsOfVertex = 4096, kGroupsOfUse = 16;

    SamplerKind kind_;
    std::uint32_t index_ = 0;
    std::uint64_t seed_, pixel_, sample_, base_ = 0;
};

// The first `dimensions` numbers of many samplers of one kind, numbers[d][i] those of sampler_at(i) for its group.
// \param points their bases, indices and groups
template <class SamplerAt>
void draw_numbers(const sobol::Points& points, std::size_t dimensions, const SamplerAt& sampler_at,
                  sampling::Row* numbers) {
    for (std::size_t i = 0; i < points.count; ++i) {
        const Sampler& sampler = sampler_at(i);
        if (sampler.kind() == SamplerKind::sobol) return sobol::draw(points, dimensions, numbers);
        const auto drawn = sampler.numbers_of(points.group[i]);
        for (std::size_t d = 0; d < dimensions; ++d) numbers[d][i] = drawn[d];
    }
}

}  // namespace limn::transport
