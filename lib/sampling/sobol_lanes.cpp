#include "sampling/sobol_lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sampling/sobol_lanes.cpp"
#include <hwy/foreach_target.h>

#include "lanes/lanes-inl.h"
#include "sampling/sobol.h"

HWY_BEFORE_NAMESPACE();
namespace limn::sampling::HWY_NAMESPACE {

using namespace limn::HWY_NAMESPACE;

using Words = hn::Rebind<std::uint32_t, Doubles::Tag>;
using LongWords = hn::Rebind<std::uint64_t, Doubles::Tag>;
using Word = hn::Vec<Words>;
using LongWord = hn::Vec<LongWords>;

HWY_INLINE Word word(std::uint32_t x) { return hn::Set(Words(), x); }

template <int kDistance>
HWY_INLINE Word swapped(Word x, std::uint32_t mask) {
    return hn::Or(hn::ShiftLeft<kDistance>(hn::And(x, word(mask))), hn::And(hn::ShiftRight<kDistance>(x), word(mask)));
}

HWY_INLINE Word reversed(Word x) {
    x = hn::Or(hn::ShiftLeft<16>(x), hn::ShiftRight<16>(x));
    x = swapped<8>(x, 0x00ff00ffU);
    x = swapped<4>(x, 0x0f0f0f0fU);
    x = swapped<2>(x, 0x33333333U);
    return swapped<1>(x, 0x55555555U);
}

template <int kDistance>
HWY_INLINE Word summed(Word x, std::uint32_t mask) {
    return hn::Xor(x, hn::ShiftLeft<kDistance>(hn::And(x, word(mask))));
}

HWY_INLINE Word pascal(Word x) {
    x = summed<16>(x, 0x0000ffffU);
    x = summed<8>(x, 0x00ff00ffU);
    x = summed<4>(x, 0x0f0f0f0fU);
    x = summed<2>(x, 0x33333333U);
    return summed<1>(x, 0x55555555U);
}

HWY_INLINE Word scrambled_upward(Word x, Word seed) {
    x = hn::Xor(x, x * word(sobol::kUpward[0]));
    x = x + seed;
    x = x * hn::Or(hn::ShiftRight<16>(seed), word(1));
    x = hn::Xor(x, x * word(sobol::kUpward[1]));
    return hn::Xor(x, x * word(sobol::kUpward[2]));
}

HWY_INLINE LongWord long_word(std::uint64_t x) { return hn::Set(LongWords(), x); }

HWY_INLINE LongWord times(LongWord a, std::uint64_t factor) {
#if HWY_TARGET == HWY_SCALAR
    return hn::Set(LongWords(), hn::GetLane(a) * factor);
#else
    return a * long_word(factor);
#endif
}

HWY_INLINE LongWord mixed(LongWord z) {
    z = times(hn::Xor(z, hn::ShiftRight<30>(z)), sobol::kMix[0]);
    z = times(hn::Xor(z, hn::ShiftRight<27>(z)), sobol::kMix[1]);
    return hn::Xor(z, hn::ShiftRight<31>(z));
}

// sobol::number.
HWY_INLINE Doubles number(Word reversed_coordinate, Word seed) {
    const Word digits = scrambled_upward(reversed_coordinate, seed);
    const Word rest = hn::ShiftRight<11>(hn::Xor(digits, seed) * word(sobol::kRestFactor));
    const LongWords d;
    const LongWord all = hn::Or(hn::ShiftLeft<21>(hn::PromoteTo(d, reversed(digits))), hn::PromoteTo(d, rest));
    return 0x1p-53 * Doubles(hn::ConvertTo(Doubles::Tag(), hn::BitCast(hn::Rebind<std::int64_t, Doubles::Tag>(), all)));
}

// Reversed columns of the generator matrices: a bit of the index, highest first, stands for one.
struct ReversedColumns {
    std::uint32_t of[sobol::kDimensions][sobol::kIndexBits];

    constexpr ReversedColumns() : of() {
        for (std::size_t d = 0; d < sobol::kDimensions; ++d) {
            const auto columns = sobol::columns(d);
            for (std::size_t k = 0; k < sobol::kIndexBits; ++k) of[d][k] = sobol::reversed(columns[k]);
        }
    }
};
constexpr ReversedColumns kColumns;

template <std::size_t n>
HWY_INLINE void draw(const SobolPoints& points, Row* numbers) {
    const Words w;
    for (std::size_t i = 0; i < points.count; i += hn::Lanes(w)) {
        const LongWord group = hn::PromoteTo(LongWords(), hn::LoadU(w, points.group + i));
        const LongWord seeds = mixed(hn::LoadU(LongWords(), points.base + i) + times(group, sobol::kStep));
        Word index = scrambled_upward(hn::LoadU(w, points.index + i), hn::TruncateTo(w, seeds));
        Word coordinate[sobol::kDimensions];
        const Word whole = hn::And(index, word(0xffffff00U));
        coordinate[0] = reversed(whole);
        if (n > 1) coordinate[1] = reversed(pascal(whole));
        for (std::size_t d = 2; d < n; ++d) coordinate[d] = hn::Zero(w);
        const hn::RebindToSigned<Words> bits;
        for (std::size_t k = 0; k < sobol::kIndexBits && n > 2; ++k) {
            const Word has_bit = hn::BitCast(w, hn::BroadcastSignBit(hn::BitCast(bits, index)));
            for (std::size_t d = 2; d < n; ++d)
                coordinate[d] = hn::Xor(coordinate[d], hn::And(has_bit, word(kColumns.of[d][k])));
            index = index + index;
        }
        for (std::size_t d = 0; d < n; ++d) {
            const Word seed = hn::TruncateTo(w, hn::ShiftRight<32>(times(seeds, sobol::kSeedFactors[d])));
            store(number(coordinate[d], seed), numbers[d] + i);
        }
    }
}

void draw_sobol(const SobolPoints& points, std::size_t dimensions, Row* numbers) {
    switch (dimensions) {
        case 1: return draw<1>(points, numbers);
        case 2: return draw<2>(points, numbers);
        case 3: return draw<3>(points, numbers);
        default: return draw<5>(points, numbers);
    }
}

}  // namespace limn::sampling::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn::sampling {

HWY_EXPORT(draw_sobol);

void draw_sobol(const SobolPoints& points, std::size_t dimensions, Row* numbers) {
    HWY_DYNAMIC_DISPATCH(draw_sobol)(points, dimensions, numbers);
}

}  // namespace limn::sampling
#endif
