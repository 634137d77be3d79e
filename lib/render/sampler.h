// Random numbers that depend on nothing but (seed, pixel, sample, dimension).
#pragma once

#include <Random123/philox.h>

#include <array>
#include <cstdint>
#include <utility>

#include "limn/core/surface.h"
#include "limn/core/vec.h"
#include "limn/render/film.h"
#include "limn/render/settings.h"
#include "sampling/sobol.h"

namespace limn::transport {

// What a vertex of a path draws numbers for.
enum class Use : std::uint32_t { light, scattering, roulette, segment, flight };

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
        base_ = sobol::seeds_of(sobol::seeds_of(sobol::mixed(seed + sobol::kStep), pixel), sequence);
        index_ = sobol::reversed(static_cast<std::uint32_t>(point)) & ~0xffU;
    }

    // What is drawn next is the first group for this use at this vertex of the path; the camera's are before vertex 1.
    void seek(int vertex, Use use) { group_ = group_of(static_cast<std::uint32_t>(vertex), use); }

    // Each takes a group. In [0, 1).
    double next() { return draw<1>()[0]; }
    Uv next_2d() {
        const auto [u, v] = draw<2>();
        return {u, v};
    }
    Random3 next_3d() {
        const auto [x, y, z] = draw<3>();
        return {x, y, z};
    }
    std::array<double, 5> next_5d() { return draw<5>(); }

    // What a batch of paths needs to draw by draw_sobol; not where numbers are independent.
    SamplerKind kind() const { return kind_; }
    std::uint64_t base() const { return base_; }
    std::uint32_t index() const { return index_; }

    // The first group for a use at a vertex; it has as many as kGroupsOfUse.
    static std::uint32_t group_of(std::uint32_t vertex, Use use) {
        return vertex * kGroupsOfVertex + static_cast<std::uint32_t>(use) * kGroupsOfUse;
    }
    // The first n numbers of the group, up to 5.
    std::array<double, 5> next_of(std::uint32_t group) {
        group_ = group;
        return draw<5>();
    }

private:
    // Flights come last, since there may be many.
    static constexpr std::uint32_t kGroupsOfVertex = 4096, kGroupsOfUse = 16;

    template <std::size_t n>
    std::array<double, n> draw() {
        const std::uint32_t group = group_++;
        if (kind_ == SamplerKind::independent) return independent<n>(group);
        const std::uint64_t seeds = sobol::seeds_of(base_, group);
        const std::uint32_t index = sobol::scrambled_upward(index_, static_cast<std::uint32_t>(seeds));
        return [&]<std::size_t... d>(std::index_sequence<d...>) {
            return std::array<double, n>{
                sobol::number(sobol::reversed_coordinate<d>(index), sobol::seed_of<d>(seeds))...};
        }
        (std::make_index_sequence<n>{});
    }

    template <std::size_t n>
    std::array<double, n> independent(std::uint32_t group) const {
        std::array<double, n> numbers{};
        for (std::size_t first = 0; first < n; first += 4) {
            const auto block = r123::Philox4x64{}({{pixel_, sample_, group, first / 4}}, {{seed_, 0}});
            for (std::size_t i = first; i < n && i < first + 4; ++i)
                numbers[i] = static_cast<double>(block[i - first] >> 11) * 0x1p-53;
        }
        return numbers;
    }

    SamplerKind kind_;
    std::uint32_t group_ = 0, index_ = 0;
    std::uint64_t seed_, pixel_, sample_, base_ = 0;
};

}  // namespace limn::transport
