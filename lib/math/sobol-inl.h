// The arithmetic of Sobol points, for one word of 32 bits or for a vector of words. The include guard is per target, as
// Highway requires.
#if defined(LIMN_MATH_SOBOL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_MATH_SOBOL_INL_H
#undef LIMN_MATH_SOBOL_INL_H
#else
#define LIMN_MATH_SOBOL_INL_H
#endif

#include "math/lanes-inl.h"
#include "math/sobol.h"

#ifndef LIMN_SAMPLING_SOBOL_COLUMNS
#define LIMN_SAMPLING_SOBOL_COLUMNS
namespace limn::sobol {

// Returns the columns of the generator matrix of a dimension. Column k is the coordinate of point 2^k, its most
// significant bit first. The primitive polynomials and the initial numbers of dimensions 1 to 4 are those of Joe and
// Kuo, Constructing Sobol sequences with better two-dimensional projections, 2008. The matrix of dimension 0 is the
// identity.
constexpr std::array<std::uint32_t, 32> columns(std::size_t dimension) {
    struct Row {
        unsigned degree;
        unsigned polynomial;  // one bit for each coefficient, including the highest and the lowest
        std::array<std::uint32_t, 4> initial;
    };
    constexpr Row kRows[kDimensions] = {
        {0, 1, {}}, {1, 0b11, {1}}, {2, 0b111, {1, 3}}, {3, 0b1011, {1, 3, 1}}, {3, 0b1101, {1, 1, 1}}};
    // Compute the direction numbers m by Sobol's recurrence.
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
    // Shift their leading bits into place: number k has k + 1 bits.
    for (unsigned k = 0; k < 32; ++k) m[k] <<= 31 - k;
    return m;
}

// Returns the bits of x in reverse order.
constexpr std::uint32_t backwards(std::uint32_t x) {
    std::uint32_t y = 0;
    for (unsigned bit = 0; bit < 32; ++bit) y |= (x >> bit & 1) << (31 - bit);
    return y;
}

// The columns of all dimensions with their bits in reverse order. Column k belongs to bit k of a point's number; that
// is the k-th bit of the reversed index, counted from the highest.
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
HWY_INLINE Doubles to_number(LongWord x) {  // \pre x < 2^63
    return hn::ConvertTo(Doubles::Tag(), hn::BitCast(hn::Rebind<std::int64_t, Doubles::Tag>(), x.v));
}
// Returns a word with all bits set if the highest bit of x is set, else 0.
HWY_INLINE Word of_sign(Word x) {
    const hn::Rebind<std::uint32_t, Doubles::Tag> d;
    return hn::BitCast(d, hn::BroadcastSignBit(hn::BitCast(hn::RebindToSigned<decltype(d)>(), x.v)));
}

// The same functions for one word.
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

// Swaps adjacent groups of n bits. `mask` has the bits of the lower group of each pair.
template <int n, class W>
HWY_INLINE W swapped(W x, std::uint32_t mask) {
    return left<n>(x & W(mask)) | (right<n>(x) & W(mask));
}

// Returns the bits of x in reverse order.
template <class W>
HWY_INLINE W reversed(W x) {
    x = left<16>(x) | right<16>(x);
    x = swapped<8>(x, 0x00ff00ffU);
    x = swapped<4>(x, 0x0f0f0f0fU);
    x = swapped<2>(x, 0x33333333U);
    return swapped<1>(x, 0x55555555U);
}

// Flips each bit depending on the seed and on the bits below it. On a number with reversed bits this is nested uniform
// scrambling (Laine and Karras, Stratified sampling for stochastic transparency, 2011). It works because multiplication
// carries towards higher bits only. The steps and constants are those of Vegdahl (Building a better LK hash, 2021);
// their flips are nearly unbiased.
template <class W>
HWY_INLINE W scrambled_upward(W x, W seed) {
    x = x ^ x * W(0x3d20adeaU);
    x = x + seed;
    x = x * (right<16>(seed) | W(1U));
    x = x ^ x * W(0x05526c56U);
    return x ^ x * W(0x53a22864U);
}

// Hashes 64 bits by a bijection: every bit of the result depends on every bit of z (splitmix64: Steele, Lea and Flood,
// Fast splittable pseudorandom number generators, 2014).
template <class L>
HWY_INLINE L mixed(L z) {
    z = (z ^ right<30>(z)) * L(0xbf58476d1ce4e5b9U);
    z = (z ^ right<27>(z)) * L(0x94d049bb133111ebU);
    return z ^ right<31>(z);
}

// 2^64 divided by the golden ratio: its multiples modulo 2^64 are far from repeating.
inline constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15;

// Returns the 64 bits that scramble one group of dimensions of the sequence `base`.
template <class L>
HWY_INLINE L seeds_of(L base, L group) {
    return mixed(base + group * L(kStep));
}

// Returns the seed of one dimension of a group from the group's 64 bits. The upper half of a product with an odd number
// depends on all bits of the other factor.
inline constexpr std::uint64_t kSeedFactors[kDimensions] = {0xd1342543de82ef95, 0xaf251af3b0f025b5, 0x2545f4914f6cdd1d,
                                                            0x9fb21c651e98df25, 0xda942042e4dd58b5};
template <class L>
HWY_INLINE auto seed_of(L seeds, std::size_t dimension) {
    return narrowed(right<32>(seeds * L(kSeedFactors[dimension])));
}

// Adds the bits in `mask` to the bits n places above them, modulo 2.
template <int n, class W>
HWY_INLINE W summed(W x, std::uint32_t mask) {
    return x ^ left<n>(x & W(mask));
}

// Computes the first n coordinates of a point, with reversed bits. `index` is the point's number with reversed bits;
// its lowest byte is ignored. The matrix of dimension 0 is the identity. The matrix of dimension 1 is Pascal's triangle
// modulo 2, the product of five sparse matrices.
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

// Scrambles a coordinate and returns it as a number in [0, 1) with 53 bits: 32 bits of the point and 21 bits of a hash.
// The longest free path is ln 2^53 = 36.7 mean free paths; with 32 bits alone it would be 22.
template <class W>
HWY_INLINE auto number_of(W reversed_coordinate, W seed) {
    const W digits = scrambled_upward(reversed_coordinate, seed);
    const W rest = right<11>((digits ^ seed) * W(0x9e3779b1U));
    return 0x1p-53 * to_number(left<21>(widened(reversed(digits))) | widened(rest));
}

// Calls visit(dimension, number) for the first n numbers of a group. The arguments are those of numbers_of().
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
