// Exact arithmetic, for decisions that cannot be made in double.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace limn {

// The leading 128 bits of a positive number: it is (2^64 high + low) 2^exponent, rounded down. The highest bit of
// `high` is set.
struct LeadingBits {
    std::uint64_t high, low;
    std::ptrdiff_t exponent;

    // Returns the leading bits of (2^128 first + 2^64 second + third) 2^exponent. \pre first is not 0
    static LeadingBits of(std::uint64_t first, std::uint64_t second, std::uint64_t third, std::ptrdiff_t exponent) {
        const int shift = std::countl_zero(first), rest = 63 - shift;
        return {first << shift | second >> rest >> 1, second << shift | third >> rest >> 1, exponent + 64 - shift};
    }
};
// Returns a / b with a relative error of at most 2^-61, then rounded to the nearest double. It is exact if the quotient
// is a double, and infinite if the quotient is beyond their range.
double ratio(const LeadingBits& a, const LeadingBits& b);

// An integer of any size times a power of two. Sums, differences and products of finite doubles are exact and do not
// overflow or underflow. An operation takes about 5 ns. Therefore filters in double are tried first.
class Dyadic {
public:
    Dyadic() = default;
    Dyadic(double x);  // \pre x is finite
    Dyadic(const Dyadic& other) { *this = other; }
    Dyadic& operator=(const Dyadic& other) {
        size_ = other.size_;
        exponent_ = other.exponent_;
        negative_ = other.negative_;
        heap_ = other.heap_;
        if (!heap_ && this != &other) std::copy_n(other.inline_.data(), size_, inline_.data());
        return *this;
    }
    ~Dyadic() = default;

    // Returns -1, 0 or 1.
    int sign() const { return size_ == 0 ? 0 : negative_ ? -1 : 1; }

    Dyadic operator-() const;
    friend Dyadic operator+(const Dyadic& a, const Dyadic& b) { return sum(a, b, b.negative_); }
    friend Dyadic operator-(const Dyadic& a, const Dyadic& b) { return sum(a, b, !b.negative_); }
    friend Dyadic operator*(const Dyadic& a, const Dyadic& b);

    // Returns the square root, rounded down to at least 62 bits. It is exact if the root has no more than 62 bits. \pre
    // sign() >= 0
    Dyadic square_root() const;

    // Returns the leading bits of the magnitude. \pre sign() != 0
    LeadingBits leading() const {
        return LeadingBits::of(limb_at(end() - 1), limb_at(end() - 2), limb_at(end() - 3), 64 * (end() - 3));
    }

private:
    using Limb = std::uint64_t;
    static constexpr std::size_t kInline = 14;  // 896 bits: enough for usual coordinates

    Dyadic(std::size_t limbs, std::ptrdiff_t exponent, bool negative)
        : size_(limbs), exponent_(exponent), negative_(negative) {
        if (limbs > kInline) heap_ = std::make_shared<Limb[]>(limbs);
    }
    // Returns a + b, where the sign of b is replaced.
    static Dyadic sum(const Dyadic& a, const Dyadic& b, bool b_negative);

    Limb* limbs() { return heap_ ? heap_.get() : inline_.data(); }
    const Limb* limbs() const { return heap_ ? heap_.get() : inline_.data(); }
    // Returns the limb of weight 2^(64 place).
    Limb limb_at(std::ptrdiff_t place) const {
        const std::ptrdiff_t i = place - exponent_;
        return i >= 0 && i < static_cast<std::ptrdiff_t>(size_) ? limbs()[i] : 0;
    }
    // Returns the place after that of the most significant limb.
    std::ptrdiff_t end() const { return exponent_ + static_cast<std::ptrdiff_t>(size_); }
    // Sets the magnitude to bits * 2^exponent.
    void set(Limb bits, std::ptrdiff_t exponent);
    // Removes zero limbs at both ends, and the heap memory if it is no longer needed.
    void trim();

    // The magnitude is the sum of limb i times 2^(64 (exponent_ + i)). The first and the last limb are not 0.
    std::size_t size_ = 0;
    std::ptrdiff_t exponent_ = 0;
    bool negative_ = false;
    std::shared_ptr<Limb[]> heap_;      // the limbs if there are more than kInline; copies share them, unchanged
    std::array<Limb, kInline> inline_;  // else the limbs; only size_ are set, clearing all takes a third more time
};

// Returns a / b, rounded as above. \pre b.sign() is not 0
template <class Number>
double ratio_of(const Number& a, const Number& b) {
    if (a.sign() == 0) return 0;
    const double magnitude = ratio(a.leading(), b.leading());
    return a.sign() != b.sign() ? -magnitude : magnitude;
}
inline double ratio(const Dyadic& a, const Dyadic& b) { return ratio_of(a, b); }

inline bool operator==(const Dyadic& a, const Dyadic& b) { return (a - b).sign() == 0; }
inline bool operator<(const Dyadic& a, const Dyadic& b) { return (a - b).sign() < 0; }

// A vector of exact numbers.
struct Dyadic3 {
    Dyadic x, y, z;
};

// Converts a point or vector exactly.
template <class Vector>
Dyadic3 to_dyadic(const Vector& v) {
    return {v.x, v.y, v.z};
}

inline Dyadic3 operator-(const Dyadic3& a, const Dyadic3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Dyadic3 operator*(const Dyadic& s, const Dyadic3& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Dyadic dot(const Dyadic3& a, const Dyadic3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Dyadic3 cross(const Dyadic3& a, const Dyadic3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace limn
