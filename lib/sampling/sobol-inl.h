// The arithmetic of Sobol points, over one word of 32 bits or a vector of them. Per-target include guard, as Highway
// has it.
#if defined(LIMN_SAMPLING_SOBOL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_SAMPLING_SOBOL_INL_H
#undef LIMN_SAMPLING_SOBOL_INL_H
#else
#define LIMN_SAMPLING_SOBOL_INL_H
#endif

#include "lanes/lanes-inl.h"
#include "sampling/sobol.h"

#ifndef LIMN_SAMPLING_SOBOL_COLUMNS
#define LIMN_SAMPLING_SOBOL_COLUMNS
namespace limn::sobol {

// Columns of the generator matrices of dimensions 1 to 4 (0 is the identity): primitive polynomials and initial numbers
// of Joe and Kuo, Constructing Sobol sequences with better two-dimensional projections, 2008. Column k is the
// coordinate of point 2^k, its most significant bit first.
constexpr std::array<std::uint32_t, 32> columns(std::size_t dimension) {
    struct Row {
        unsigned degree, polynomial;  // with its highest and lowest coefficient
        std::array<std::uint32_t, 4> initial;
    };
    constexpr Row kRows[kDimensions] = {
        {0, 1, {}}, {1, 0b11, {1}}, {2, 0b111, {1, 3}}, {3, 0b1011, {1, 3, 1}}, {3, 0b1101, {1, 1, 1}}};
    const Row& row = kRows[dimension];
    std::array<std::uint32_t, 32> m{};
    for (unsigned k = 0; k < 32; ++k) {
        if (row.degree == 0) {
            m[k] = 1;
        } else if (k < row.degree) {
            m[k] = row.initial[k];
        } else {
            m[k] = m[k - row.degree];
            for (unsigned i = 1; i <= row.degree; ++i)
                if ((row.polynomial >> (row.degree - i)) & 1) m[k] ^= m[k - i] << i;
        }
    }
    for (unsigned k = 0; k < 32; ++k) m[k] <<= 31 - k;
    return m;
}

constexpr std::uint32_t backwards(std::uint32_t x) {
    std::uint32_t y = 0;
    for (unsigned bit = 0; bit < 32; ++bit) y |= (x >> bit & 1) << (31 - bit);
    return y;
}

// A bit of the index, highest first, stands for each.
struct ReversedColumns {
    std::uint32_t of[kDimensions][kIndexBits] = {};

    constexpr ReversedColumns() {
        for (std::size_t d = 0; d < kDimensions; ++d)
            for (std::size_t k = 0; k < kIndexBits; ++k) of[d][k] = backwards(columns(d)[k]);
    }
};
inline constexpr ReversedColumns kReversedColumns;

}  // namespace limn::sobol
#endif

HWY_BEFORE_NAMESPACE();
namespace limn::sobol::HWY_NAMESPACE {

using namespace limn::HWY_NAMESPACE;

// A vector of words.
template <class D>
struct Words {
    hn::Vec<D> v;

    Words() = default;
    HWY_INLINE Words(hn::Vec<D> lanes) : v(lanes) {}
    HWY_INLINE Words(hn::TFromD<D> x) : v(hn::Set(D(), x)) {}

    friend LIMN_ALWAYS_INLINE Words operator^(Words a, Words b) { return hn::Xor(a.v, b.v); }
    friend LIMN_ALWAYS_INLINE Words operator&(Words a, Words b) { return hn::And(a.v, b.v); }
    friend LIMN_ALWAYS_INLINE Words operator|(Words a, Words b) { return hn::Or(a.v, b.v); }
    friend LIMN_ALWAYS_INLINE Words operator+(Words a, Words b) { return hn::Add(a.v, b.v); }
    friend LIMN_ALWAYS_INLINE Words operator*(Words a, Words b) {
#if HWY_TARGET == HWY_SCALAR
        return hn::Set(D(), hn::GetLane(a.v) * hn::GetLane(b.v));
#else
        return a.v * b.v;
#endif
    }
};
using Word = Words<hn::Rebind<std::uint32_t, Doubles::Tag>>;
using LongWord = Words<hn::Rebind<std::uint64_t, Doubles::Tag>>;

template <int n, class D>
HWY_INLINE Words<D> left(Words<D> x) {
    return hn::ShiftLeft<n>(x.v);
}
template <int n, class D>
HWY_INLINE Words<D> right(Words<D> x) {
    return hn::ShiftRight<n>(x.v);
}
HWY_INLINE LongWord widened(Word x) { return hn::PromoteTo(hn::Rebind<std::uint64_t, Doubles::Tag>(), x.v); }
HWY_INLINE Word narrowed(LongWord x) { return hn::TruncateTo(hn::Rebind<std::uint32_t, Doubles::Tag>(), x.v); }
HWY_INLINE Doubles to_number(LongWord x) {  // below 2^63
    return hn::ConvertTo(Doubles::Tag(), hn::BitCast(hn::Rebind<std::int64_t, Doubles::Tag>(), x.v));
}
// All bits where the highest one is set, else none.
HWY_INLINE Word of_sign(Word x) {
    const hn::Rebind<std::uint32_t, Doubles::Tag> d;
    return hn::BitCast(d, hn::BroadcastSignBit(hn::BitCast(hn::RebindToSigned<decltype(d)>(), x.v)));
}

// The same verbs for one word.
template <int n, class W>
HWY_INLINE W left(W x) {
    return x << n;
}
template <int n, class W>
HWY_INLINE W right(W x) {
    return x >> n;
}
HWY_INLINE std::uint64_t widened(std::uint32_t x) { return x; }
HWY_INLINE std::uint32_t narrowed(std::uint64_t x) { return static_cast<std::uint32_t>(x); }
HWY_INLINE double to_number(std::uint64_t x) { return static_cast<double>(static_cast<std::int64_t>(x)); }
HWY_INLINE std::uint32_t of_sign(std::uint32_t x) { return 0 - (x >> 31); }

template <int n, class W>
HWY_INLINE W swapped(W x, std::uint32_t mask) {
    return left<n>(x & W(mask)) | (right<n>(x) & W(mask));
}

// Bits in the opposite order.
template <class W>
HWY_INLINE W reversed(W x) {
    x = left<16>(x) | right<16>(x);
    x = swapped<8>(x, 0x00ff00ffU);
    x = swapped<4>(x, 0x0f0f0f0fU);
    x = swapped<2>(x, 0x33333333U);
    return swapped<1>(x, 0x55555555U);
}

// Flips each bit depending on the seed and the bits below it: a nested uniform scrambling of the number read backwards
// (Laine and Karras, Stratified sampling for stochastic transparency, 2011). Multiplication carries upward only. The
// steps and constants are Vegdahl's (Building a better LK hash, 2021), whose flips are nearly unbiased.
template <class W>
HWY_INLINE W scrambled_upward(W x, W seed) {
    x = x ^ x * W(0x3d20adeaU);
    x = x + seed;
    x = x * (right<16>(seed) | W(1U));
    x = x ^ x * W(0x05526c56U);
    return x ^ x * W(0x53a22864U);
}

// Bijection of 64 bits in which every bit depends on every other (splitmix64: Steele, Lea and Flood, Fast splittable
// pseudorandom number generators, 2014).
template <class L>
HWY_INLINE L mixed(L z) {
    z = (z ^ right<30>(z)) * L(0xbf58476d1ce4e5b9U);
    z = (z ^ right<27>(z)) * L(0x94d049bb133111ebU);
    return z ^ right<31>(z);
}

// The group of dimensions that has this number, of the samples that have this base, is scrambled by these 64 bits.
inline constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15;  // 2^64 over the golden ratio: far from any small ratio
template <class L>
HWY_INLINE L seeds_of(L base, L group) {
    return mixed(base + group * L(kStep));
}

// A dimension's part of them. The high half of a product with an odd number depends on all bits of the other factor.
inline constexpr std::uint64_t kSeedFactors[kDimensions] = {0xd1342543de82ef95, 0xaf251af3b0f025b5, 0x2545f4914f6cdd1d,
                                                            0x9fb21c651e98df25, 0xda942042e4dd58b5};
template <class L>
HWY_INLINE auto seed_of(L seeds, std::size_t dimension) {
    return narrowed(right<32>(seeds * L(kSeedFactors[dimension])));
}

template <int n, class W>
HWY_INLINE W summed(W x, std::uint32_t mask) {
    return x ^ left<n>(x & W(mask));
}

// The first n coordinates, reversed, of the point whose index, reversed, is `index`. Its lowest byte does not count.
// Dimension 0 has the identity as its matrix, and 1 Pascal's triangle modulo 2, a product of five sparse ones.
template <std::size_t n, class W>
HWY_INLINE void find_coordinates(W index, W* coordinates) {
    const W whole = index & W(0xffffff00U);
    coordinates[0] = reversed(whole);
    if (n > 1)
        coordinates[1] = reversed(
            summed<1>(summed<2>(summed<4>(summed<8>(summed<16>(whole, 0xffffU), 0xff00ffU), 0xf0f0f0fU), 0x33333333U),
                      0x55555555U));
    for (std::size_t d = 2; d < n; ++d) coordinates[d] = W(0U);
    for (std::size_t k = 0; k < kIndexBits && n > 2; ++k) {
        const W has_bit = of_sign(index);
        for (std::size_t d = 2; d < n; ++d) coordinates[d] = coordinates[d] ^ (has_bit & W(kReversedColumns.of[d][k]));
        index = index + index;
    }
}

// A scrambled coordinate in [0, 1), of 53 bits, so that a free path can be long: 32 of the point, the others merely
// random.
template <class W>
HWY_INLINE auto number_of(W reversed_coordinate, W seed) {
    const W digits = scrambled_upward(reversed_coordinate, seed);
    const W rest = right<11>((digits ^ seed) * W(0x9e3779b1U));
    return 0x1p-53 * to_number(left<21>(widened(reversed(digits))) | widened(rest));
}

// visit(dimension, number) for the first n numbers of a group.
template <std::size_t n, class L, class W, class Visit>
HWY_INLINE void draw_numbers(L base, W index, W group, const Visit& visit) {
    const L seeds = seeds_of(base, widened(group));
    W coordinates[kDimensions];
    find_coordinates<n>(scrambled_upward(index, narrowed(seeds)), coordinates);
    for (std::size_t d = 0; d < n; ++d) visit(d, number_of(coordinates[d], seed_of(seeds, d)));
}

}  // namespace limn::sobol::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
