// Integers of a fixed number of bits: the first stage of the exact fallback. They hold all but unusual coordinates, and
// take a fraction of the time of integers of any length (dyadic.h).
#pragma once

#include <bit>
#include <cstdint>

#include "geometry/dyadic.h"

namespace limn {

__extension__ using Int128 = __int128;

// An integer of 192 bits: 2^64 high + low.
struct Int192 {
    Int128 high = 0;
    std::uint64_t low = 0;

    int sign() const { return high != 0 ? (high < 0 ? -1 : 1) : low != 0; }
    friend Int192 operator+(const Int192& a, const Int192& b) {
        const std::uint64_t sum = a.low + b.low;
        return {a.high + b.high + (sum < a.low ? 1 : 0), sum};
    }
    friend Int192 operator-(const Int192& a, const Int192& b) {
        return {a.high - b.high - (a.low < b.low ? 1 : 0), a.low - b.low};
    }
    static Int192 product(Int128 a, std::int64_t b) {
        __extension__ using Wide = unsigned __int128;
        // The product of the lower half of `a`, which has no sign, and of the upper half.
        const auto lower = static_cast<std::uint64_t>(a);
        const auto unsigned_b = static_cast<std::uint64_t>(b);
        const Wide bits = Wide{lower} * unsigned_b;
        const auto up = static_cast<std::uint64_t>(bits >> 64) - (b < 0 ? lower : 0);
        return {(a >> 64) * b + static_cast<std::int64_t>(up), static_cast<std::uint64_t>(bits)};
    }
    // Returns the leading bits of the magnitude. \pre sign() != 0
    LeadingBits leading() const {
        const Int192 size = high < 0 ? Int192{} - *this : *this;
        const auto upper = static_cast<std::uint64_t>(size.high >> 64), middle = static_cast<std::uint64_t>(size.high);
        if (upper != 0) return LeadingBits::of(upper, middle, size.low, 0);
        return middle != 0 ? LeadingBits::of(middle, size.low, 0, -64) : LeadingBits::of(size.low, 0, 0, -128);
    }
};

inline double ratio(const Int192& a, const Int192& b) { return ratio_of(a, b); }

struct Int64x3 {
    std::int64_t x, y, z;

    friend Int64x3 operator-(const Int64x3& a, const Int64x3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
};
struct Int128x3 {
    Int128 x, y, z;
};
inline Int128x3 cross(const Int64x3& a, const Int64x3& b) {
    return {Int128{a.y} * b.z - Int128{a.z} * b.y, Int128{a.z} * b.x - Int128{a.x} * b.z,
            Int128{a.x} * b.y - Int128{a.y} * b.x};
}
inline Int192 dot(const Int128x3& a, const Int64x3& b) {
    return Int192::product(a.x, b.x) + Int192::product(a.y, b.y) + Int192::product(a.z, b.z);
}

// Converts doubles to multiples of a common unit 2^-shift.
class FixedGrid {
public:
    // \pre the numbers are at most `largest` in magnitude
    explicit FixedGrid(double largest) : is_exact_(largest > 0x1p-900 && largest < 0x1p60) {
        if (!is_exact_) return;
        const int exponent = static_cast<int>(std::bit_cast<std::uint64_t>(largest) >> 52) - kBias;
        shift_ = 60 - exponent;
        scale_ = std::bit_cast<double>(static_cast<std::uint64_t>(shift_ + kBias) << 52);  // at least 1: no underflow
    }

    int shift() const { return shift_; }
    bool is_exact() const { return is_exact_; }  // false if a number was not a multiple of the unit, or out of range

    // Returns x in this unit. The result is below 2^61 in magnitude, or 0 if `largest` was out of range.
    std::int64_t operator()(double x) {
        const double scaled = x * scale_;
        const auto fixed = static_cast<std::int64_t>(scaled);
        is_exact_ = is_exact_ && static_cast<double>(fixed) == scaled;
        return fixed;
    }
    template <class Vector>
    Int64x3 operator()(const Vector& v) {
        return {(*this)(v.x), (*this)(v.y), (*this)(v.z)};
    }

private:
    static constexpr int kBias = 1023;  // of the exponent in the bits of a double

    int shift_ = 0;
    double scale_ = 0;  // 2^shift, or 0 if `largest` was out of range
    bool is_exact_;
};

}  // namespace limn
