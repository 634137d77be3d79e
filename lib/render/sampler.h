// Random numbers as a function of (seed, pixel, sample, dimension) alone.
#pragma once

#include <Random123/philox.h>

#include <array>
#include <cstdint>

#include "limn/render/film.h"
#include "limn/render/settings.h"
#include "math/sobol.h"

namespace limn::transport {

// The purpose for which a vertex of a path draws numbers.
enum class Use : std::uint32_t { light, scattering, roulette, segment, flight, holes };

// The random numbers of one sample of a pixel. They are drawn in groups of up to five dimensions. Within a group, the
// samples of a pixel form a Sobol sequence. The groups are scrambled and shuffled independently (Burley, Practical
// hash-based Owen scrambling, 2020), so a path may use any number of them. A number for a certain use at a certain
// vertex belongs to the same group in all samples of a pixel, whatever other numbers they draw.
//
// Each of the film's replicates has a randomisation of its own: sample i is point i / 2 of replicate i mod 2.
//
// SamplerKind::independent uses Philox4x64-10 instead, one block for every four numbers of a group (Salmon et al.,
// Parallel random numbers: as easy as 1, 2, 3, 2011).
class Sampler {
public:
    Sampler(std::uint64_t seed, std::uint64_t pixel, std::uint64_t sample, SamplerKind kind = SamplerKind::sobol)
        : kind_(kind), seed_(seed), pixel_(pixel), sample_(sample) {
        if (kind_ == SamplerKind::independent) return;
        const std::uint64_t point = sample / Film::kReplicates, replicate = sample % Film::kReplicates;
        // A sequence has 2^24 points. Further points come from another randomisation.
        const std::uint64_t sequence = (point >> sobol::kIndexBits) * Film::kReplicates + replicate;
        base_ = sobol::base_of(seed, pixel, sequence);
        index_ = sobol::index_of(static_cast<std::uint32_t>(point));
    }

    SamplerKind kind() const { return kind_; }
    // The base and index for sobol::draw; 0 if the numbers are independent.
    std::uint64_t base() const { return base_; }
    std::uint32_t index() const { return index_; }

    // Returns the group of a use at a vertex. Vertices are counted from 1. Group 0 is the camera's.
    static std::uint32_t group_of(std::uint32_t vertex, Use use) {
        return vertex * kGroupsOfVertex + static_cast<std::uint32_t>(use) * kGroupsOfUse;
    }
    // Returns the numbers of a group, in [0, 1).
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
    // A vertex has room for 256 uses of 16 groups each. That is more than are needed, so a new use does not change the
    // numbers of the others.
    static constexpr std::uint32_t kGroupsOfVertex = 4096, kGroupsOfUse = 16;

    SamplerKind kind_;
    std::uint32_t index_ = 0;
    std::uint64_t seed_, pixel_, sample_, base_ = 0;
};

// Draws the first `dimensions` numbers of many samplers of one kind. numbers[d][i] becomes dimension d of sampler_at(i)
// in group points.group[i].
// \param points the bases, indices and groups of the samplers
// \pre points.count <= kShaded, 1 <= dimensions <= 5
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
