// Sobol points whose order and digits are scrambled by hashing: Owen's nested uniform scrambling (Randomly permuted
// (t,m,s)-nets and (t,s)-sequences, 1995) without storing any permutation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace limn::sobol {

inline constexpr std::size_t kDimensions = 5;
// Points of one randomisation; the coordinates are looked up a byte of the index at a time.
inline constexpr int kIndexBits = 24;

// Bits in the opposite order.
constexpr std::uint32_t reversed(std::uint32_t x) {
    x = __builtin_bswap32(x);
    x = ((x & 0x0f0f0f0fU) << 4) | ((x >> 4) & 0x0f0f0f0fU);
    x = ((x & 0x33333333U) << 2) | ((x >> 2) & 0x33333333U);
    return ((x & 0x55555555U) << 1) | ((x >> 1) & 0x55555555U);
}

// Flips each bit depending on the seed and the bits below it: a nested uniform scrambling of the number read backwards
// (Laine and Karras, Stratified sampling for stochastic transparency, 2011). Multiplication carries upward only.
// The steps and constants are Vegdahl's (Building a better LK hash, 2021), whose flips are nearly unbiased.
inline constexpr std::uint32_t kUpward[] = {0x3d20adea, 0x05526c56, 0x53a22864};
constexpr std::uint32_t scrambled_upward(std::uint32_t x, std::uint32_t seed) {
    x ^= x * kUpward[0];
    x += seed;
    x *= (seed >> 16) | 1;
    x ^= x * kUpward[1];
    x ^= x * kUpward[2];
    return x;
}

// Bijection of 64 bits in which every bit depends on every other (splitmix64: Steele, Lea and Flood, Fast splittable
// pseudorandom number generators, 2014).
inline constexpr std::uint64_t kMix[] = {0xbf58476d1ce4e5b9, 0x94d049bb133111eb};
constexpr std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * kMix[0];
    z = (z ^ (z >> 27)) * kMix[1];
    return z ^ (z >> 31);
}

// The group of dimensions that has this number, of the samples that have this base, is scrambled by these 64 bits.
inline constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15;  // 2^64 over the golden ratio: far from any small ratio
constexpr std::uint64_t seeds_of(std::uint64_t base, std::uint64_t group) { return mixed(base + kStep * group); }

// A dimension's part of them. The high half of a product with an odd number depends on all bits of the other factor.
inline constexpr std::uint64_t kSeedFactors[kDimensions] = {0xd1342543de82ef95, 0xaf251af3b0f025b5, 0x2545f4914f6cdd1d,
                                                            0x9fb21c651e98df25, 0xda942042e4dd58b5};
template <std::size_t dimension>
std::uint32_t seed_of(std::uint64_t seeds) {
    return static_cast<std::uint32_t>((seeds * kSeedFactors[dimension]) >> 32);
}

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

// For each byte of a reversed index, highest first, the part of the reversed coordinate that it gives.
using Table = std::array<std::array<std::uint32_t, 256>, kIndexBits / 8>;

constexpr Table table(std::size_t dimension) {
    const std::array<std::uint32_t, 32> column = columns(dimension);
    Table t{};
    for (unsigned byte = 0; byte < kIndexBits / 8; ++byte)
        for (unsigned value = 0; value < 256; ++value)
            for (unsigned bit = 0; bit < 8; ++bit)
                if (value & (0x80U >> bit)) t[byte][value] ^= reversed(column[8 * byte + bit]);
    return t;
}

inline constexpr std::array<Table, kDimensions - 2> kTables{table(2), table(3), table(4)};

// The coordinate in dimension 1 of a point whose index is reversed: its matrix is Pascal's triangle modulo 2, a product
// of five sparse ones.
constexpr std::uint32_t pascal(std::uint32_t x) {
    x ^= (x & 0x0000ffffU) << 16;
    x ^= (x & 0x00ff00ffU) << 8;
    x ^= (x & 0x0f0f0f0fU) << 4;
    x ^= (x & 0x33333333U) << 2;
    return x ^ (x & 0x55555555U) << 1;
}

// Coordinate `dimension` of the point whose index, reversed, is `index`; reversed itself. The lowest byte does not
// count.
template <std::size_t dimension>
std::uint32_t reversed_coordinate(std::uint32_t index) {
    if constexpr (dimension == 0) {
        return reversed(index & 0xffffff00U);
    } else if constexpr (dimension == 1) {
        return reversed(pascal(index & 0xffffff00U));
    } else {
        const Table& t = kTables[dimension - 2];
        return t[0][index >> 24] ^ t[1][(index >> 16) & 255] ^ t[2][(index >> 8) & 255];
    }
}

// The scrambled coordinate in [0, 1), of 53 bits, so that a free path can be long: 32 of the point, the others merely
// random.
inline constexpr std::uint32_t kRestFactor = 0x9e3779b1;
inline double number(std::uint32_t reversed_coordinate, std::uint32_t seed) {
    const std::uint32_t bits = scrambled_upward(reversed_coordinate, seed);
    const std::uint32_t rest = (bits ^ seed) * kRestFactor >> 11;
    const std::uint64_t all = static_cast<std::uint64_t>(reversed(bits)) << 21 | rest;
    return static_cast<double>(static_cast<std::int64_t>(all)) * 0x1p-53;
}

}  // namespace limn::sobol
