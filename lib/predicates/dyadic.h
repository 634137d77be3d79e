// Exact numbers for the decisions that double cannot make.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace limn {

// An integer times a power of two, as large as it has to be: sums, differences and products of finite doubles are
// exact, without overflow or underflow. Slow beside a double (some 20 ns an operation), so filters come first.
class Dyadic {
public:
    Dyadic() = default;
    Dyadic(double x);  // exactly; \pre finite
    Dyadic(const Dyadic& other) { *this = other; }
    Dyadic& operator=(const Dyadic& other) {
        size_ = other.size_, exponent_ = other.exponent_, negative_ = other.negative_, heap_ = other.heap_;
        if (!heap_ && this != &other) std::copy_n(other.inline_.data(), size_, inline_.data());
        return *this;
    }
    ~Dyadic() = default;

    int sign() const { return size_ == 0 ? 0 : negative_ ? -1 : 1; }

    Dyadic operator-() const;
    friend Dyadic operator+(const Dyadic& a, const Dyadic& b);
    friend Dyadic operator-(const Dyadic& a, const Dyadic& b) { return a + -b; }
    friend Dyadic operator*(const Dyadic& a, const Dyadic& b);

    // The square root, rounded down to 62 bits or more; exact for squares of so few. \pre sign() >= 0
    Dyadic square_root() const;

    // a / b, off by at most 2^-61 of itself before it is rounded to the nearest double: exact where a double can say
    // it. Infinite beyond the range of doubles. \pre b.sign() != 0
    friend double ratio(const Dyadic& a, const Dyadic& b);

private:
    using Limb = std::uint64_t;
    static constexpr std::size_t kInline = 14;  // 896 bits: what usual coordinates need

    Dyadic(std::size_t limbs, std::ptrdiff_t exponent, bool negative)
        : size_(limbs), exponent_(exponent), negative_(negative) {
        if (limbs > kInline) heap_ = std::make_shared<Limb[]>(limbs);
    }
    Limb* limbs() { return heap_ ? heap_.get() : inline_.data(); }
    const Limb* limbs() const { return heap_ ? heap_.get() : inline_.data(); }
    Limb limb_at(std::ptrdiff_t place) const {  // of weight 2^(64 place)
        const std::ptrdiff_t i = place - exponent_;
        return i >= 0 && i < static_cast<std::ptrdiff_t>(size_) ? limbs()[i] : 0;
    }
    std::ptrdiff_t end() const { return exponent_ + static_cast<std::ptrdiff_t>(size_); }
    void set(Limb bits, std::ptrdiff_t exponent);  // to bits times 2^exponent
    void trim();

    // The leading 128 bits, the first of them set: about {high, low} 2^exponent, rounded down.
    struct Leading {
        Limb high, low;
        std::ptrdiff_t exponent;
    };
    Leading leading() const;

    // Limbs from the least significant on; the value is their sum times 2^(64 exponent_). No limb at either end is 0.
    std::size_t size_ = 0;
    std::ptrdiff_t exponent_ = 0;
    bool negative_ = false;
    std::shared_ptr<Limb[]> heap_;      // shared by copies: the limbs stay as they were made
    std::array<Limb, kInline> inline_;  // only size_ of them are set: to clear all would take a third more time
};

double ratio(const Dyadic& a, const Dyadic& b);

inline bool operator==(const Dyadic& a, const Dyadic& b) { return (a - b).sign() == 0; }
inline bool operator<(const Dyadic& a, const Dyadic& b) { return (a - b).sign() < 0; }

struct Dyadic3 {
    Dyadic x, y, z;
};

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
