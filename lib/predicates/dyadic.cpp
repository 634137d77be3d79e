#include "predicates/dyadic.h"

#include <bit>
#include <cmath>
#include <utility>

namespace limn {

namespace {

__extension__ using Wide = unsigned __int128;

std::uint64_t low(Wide x) { return static_cast<std::uint64_t>(x); }
std::uint64_t high(Wide x) { return static_cast<std::uint64_t>(x >> 64); }

}  // namespace

Dyadic::Dyadic(double x) {
    if (x == 0) return;
    int exponent = 0;
    const double fraction = std::frexp(std::abs(x), &exponent);
    const auto bits = static_cast<Limb>(std::ldexp(fraction, 53));
    exponent -= 53;
    const int place = exponent >= 0 ? exponent / 64 : -((63 - exponent) / 64);  // rounded down
    const Wide shifted = Wide{bits} << (exponent - 64 * place);
    negative_ = x < 0;
    exponent_ = place;
    size_ = 2;
    inline_[0] = low(shifted), inline_[1] = high(shifted);
    trim();
}

Dyadic::Dyadic(const Dyadic& other) : Dyadic(other.size_) {
    exponent_ = other.exponent_;
    negative_ = other.negative_;
    std::copy_n(other.limbs(), size_, limbs());
}

Dyadic::Dyadic(Dyadic&& other) noexcept
    : size_(other.size_), exponent_(other.exponent_), negative_(other.negative_), heap_(std::move(other.heap_)) {
    if (!heap_) std::copy_n(other.inline_.data(), size_, inline_.data());
    other.size_ = 0;
}

Dyadic& Dyadic::operator=(Dyadic other) noexcept {
    size_ = std::exchange(other.size_, 0);
    exponent_ = other.exponent_;
    negative_ = other.negative_;
    heap_ = std::move(other.heap_);
    if (!heap_) std::copy_n(other.inline_.data(), size_, inline_.data());
    return *this;
}

// Keeps numbers short: no zero limb at either end.
void Dyadic::trim() {
    while (size_ > 0 && limbs()[size_ - 1] == 0) --size_;
    std::size_t zeros = 0;
    while (zeros < size_ && limbs()[zeros] == 0) ++zeros;
    if (zeros > 0) {
        std::copy(limbs() + zeros, limbs() + size_, limbs());
        size_ -= zeros;
        exponent_ += static_cast<std::ptrdiff_t>(zeros);
    }
    if (heap_ && size_ <= kInline) {
        std::copy_n(heap_.get(), size_, inline_.data());
        heap_.reset();
    }
}

Dyadic Dyadic::operator-() const {
    Dyadic opposite = *this;
    opposite.negative_ = !negative_;
    return opposite;
}

int Dyadic::compare_magnitudes(const Dyadic& a, const Dyadic& b) {
    if (a.end() != b.end()) return a.end() < b.end() ? -1 : 1;
    const std::ptrdiff_t first = std::min(a.exponent_, b.exponent_);
    for (std::ptrdiff_t place = a.end(); place-- > first;) {
        const Limb x = a.limb_at(place), y = b.limb_at(place);
        if (x != y) return x < y ? -1 : 1;
    }
    return 0;
}

Dyadic Dyadic::sum_of_magnitudes(const Dyadic& a, const Dyadic& b) {
    const std::ptrdiff_t first = std::min(a.exponent_, b.exponent_), last = std::max(a.end(), b.end());
    Dyadic sum(static_cast<std::size_t>(last - first + 1));
    sum.exponent_ = first;
    Wide carry = 0;
    for (std::ptrdiff_t place = first; place <= last; ++place) {
        carry += Wide{a.limb_at(place)} + b.limb_at(place);
        sum.limbs()[place - first] = low(carry);
        carry >>= 64;
    }
    sum.trim();
    return sum;
}

Dyadic Dyadic::difference_of_magnitudes(const Dyadic& larger, const Dyadic& smaller) {
    const std::ptrdiff_t first = std::min(larger.exponent_, smaller.exponent_), last = larger.end();
    Dyadic difference(static_cast<std::size_t>(last - first));
    difference.exponent_ = first;
    Limb borrow = 0;
    for (std::ptrdiff_t place = first; place < last; ++place) {
        const Wide x = Wide{larger.limb_at(place)}, y = Wide{smaller.limb_at(place)} + borrow;
        difference.limbs()[place - first] = low(x - y);
        borrow = x < y ? 1 : 0;
    }
    difference.trim();
    return difference;
}

Dyadic operator+(const Dyadic& a, const Dyadic& b) {
    if (a.size_ == 0) return b;
    if (b.size_ == 0) return a;
    Dyadic sum;
    if (a.negative_ == b.negative_) {
        sum = Dyadic::sum_of_magnitudes(a, b);
        sum.negative_ = a.negative_;
    } else {
        const int order = Dyadic::compare_magnitudes(a, b);
        if (order == 0) return {};
        sum = order > 0 ? Dyadic::difference_of_magnitudes(a, b) : Dyadic::difference_of_magnitudes(b, a);
        sum.negative_ = order > 0 ? a.negative_ : b.negative_;
    }
    return sum;
}

Dyadic operator*(const Dyadic& a, const Dyadic& b) {
    if (a.size_ == 0 || b.size_ == 0) return {};
    Dyadic product(a.size_ + b.size_);
    product.exponent_ = a.exponent_ + b.exponent_;
    product.negative_ = a.negative_ != b.negative_;
    std::fill_n(product.limbs(), product.size_, 0);
    for (std::size_t i = 0; i < a.size_; ++i) {
        Wide carry = 0;
        for (std::size_t j = 0; j < b.size_; ++j) {
            carry += Wide{a.limbs()[i]} * b.limbs()[j] + product.limbs()[i + j];
            product.limbs()[i + j] = low(carry);
            carry >>= 64;
        }
        product.limbs()[i + b.size_] = low(carry);
    }
    product.trim();
    return product;
}

Dyadic::Leading Dyadic::leading() const {
    const Limb first = limb_at(end() - 1), second = limb_at(end() - 2), third = limb_at(end() - 3);
    const int shift = std::countl_zero(first);
    const std::ptrdiff_t exponent = 64 * (end() - 2) - shift;
    if (shift == 0) return {first, second, exponent};
    return {first << shift | second >> (64 - shift), second << shift | third >> (64 - shift), exponent};
}

double ratio(const Dyadic& a, const Dyadic& b) {
    if (a.size_ == 0) return 0;
    const Dyadic::Leading over = a.leading(), under = b.leading();
    // Halved, so that the quotient by the upper half of b, at least 2^63, fits into 64 bits; it has 62 of them or more.
    const Wide numerator = (Wide{over.high} << 64 | over.low) >> 1;
    const double quotient = static_cast<double>(low(numerator / under.high));
    const std::ptrdiff_t exponent = std::clamp<std::ptrdiff_t>(over.exponent + 1 - (under.exponent + 64), -9999, 9999);
    const double magnitude = std::ldexp(quotient, static_cast<int>(exponent));
    return a.negative_ != b.negative_ ? -magnitude : magnitude;
}

Dyadic Dyadic::square_root() const {
    if (size_ == 0) return {};
    // An even exponent, and at most 2^126, so that the root fits into 63 bits.
    const Leading top = leading();
    const int shift = top.exponent % 2 == 0 ? 2 : 3;
    const Wide square = (Wide{top.high} << 64 | top.low) >> shift;
    // Newton's iteration doubles the 53 bits of the first guess.
    auto root = static_cast<Limb>(std::sqrt(static_cast<double>(square)));
    root = low((root + square / root) / 2);
    while (Wide{root} * root > square) --root;
    Dyadic result = static_cast<double>(root >> 32);
    result = result * Dyadic(0x1p32) + Dyadic(static_cast<double>(root & 0xffffffff));
    Dyadic scale(1.0);
    std::ptrdiff_t exponent = (top.exponent + shift) / 2;
    scale.exponent_ = (exponent - ((exponent % 64) + 64) % 64) / 64;
    scale.inline_[0] = Limb{1} << (exponent - 64 * scale.exponent_);
    return result * scale;
}

}  // namespace limn
