#include "geometry/dyadic.h"

#include <bit>
#include <cmath>

namespace limn {

namespace {

__extension__ using Wide = unsigned __int128;
__extension__ using SignedWide = __int128;

std::uint64_t low(Wide x) { return static_cast<std::uint64_t>(x); }
std::uint64_t high(Wide x) { return static_cast<std::uint64_t>(x >> 64); }

}  // namespace

Dyadic::Dyadic(double x) {
    int exponent = 0;
    const double fraction = std::frexp(std::abs(x), &exponent);
    set(static_cast<Limb>(std::ldexp(fraction, 53)), exponent - 53);
    negative_ = x < 0;
}

void Dyadic::set(Limb bits, std::ptrdiff_t exponent) {
    exponent_ = exponent >> 6;  // exponent / 64, rounded down
    const Wide shifted = Wide{bits} << (exponent & 63);
    size_ = 2;
    inline_[0] = low(shifted);
    inline_[1] = high(shifted);
    trim();
}

void Dyadic::trim() {
    // Drop zero limbs at both ends.
    while (size_ > 0 && limbs()[size_ - 1] == 0) --size_;
    std::size_t zeros = 0;
    while (zeros < size_ && limbs()[zeros] == 0) ++zeros;
    if (zeros > 0) {
        std::copy(limbs() + zeros, limbs() + size_, limbs());
        size_ -= zeros;
        exponent_ += static_cast<std::ptrdiff_t>(zeros);
    }
    // Move the limbs out of the heap if they fit.
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

Dyadic operator+(const Dyadic& a, const Dyadic& b) {
    if (a.size_ == 0) return b;
    if (b.size_ == 0) return a;
    const std::ptrdiff_t first = std::min(a.exponent_, b.exponent_), last = std::max(a.end(), b.end());
    Dyadic sum(static_cast<std::size_t>(last - first + 1), first, a.negative_);
    Dyadic::Limb* const limbs = sum.limbs();
    // Add the limbs, with the sign of `a` taken as positive. A negative carry is a borrow. If the last carry is
    // negative, the limbs are the sum in two's complement.
    SignedWide carry = 0;
    for (std::ptrdiff_t place = first; place <= last; ++place) {
        const SignedWide x = a.limb_at(place), y = b.limb_at(place);
        carry += a.negative_ == b.negative_ ? x + y : x - y;
        limbs[place - first] = static_cast<Dyadic::Limb>(carry);
        carry >>= 64;
    }
    // Negate the limbs of a negative sum.
    if (carry < 0) {
        sum.negative_ = !a.negative_;
        Wide up = 1;
        for (std::size_t i = 0; i < sum.size_; ++i) {
            up += ~limbs[i];
            limbs[i] = low(up);
            up >>= 64;
        }
    }
    sum.trim();
    return sum;
}

Dyadic operator*(const Dyadic& a, const Dyadic& b) {
    if (a.size_ == 0 || b.size_ == 0) return {};
    Dyadic product(a.size_ + b.size_, a.exponent_ + b.exponent_, a.negative_ != b.negative_);
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
    // Divide half of the leading 128 bits of `a` by the leading 64 bits of `b`, which are at least 2^63. The halving
    // makes the quotient fit into 64 bits. The quotient has at least 62 bits.
    const Wide numerator = (Wide{over.high} << 64 | over.low) >> 1;
    const double quotient = static_cast<double>(low(numerator / under.high));
    const std::ptrdiff_t exponent = std::clamp<std::ptrdiff_t>(over.exponent + 1 - (under.exponent + 64), -9999, 9999);
    const double magnitude = std::ldexp(quotient, static_cast<int>(exponent));
    return a.negative_ != b.negative_ ? -magnitude : magnitude;
}

Dyadic Dyadic::square_root() const {
    if (size_ == 0) return {};
    // Shift the leading bits so that their exponent is even and they are below 2^126. Then the root has at most 63
    // bits.
    const Leading top = leading();
    const int shift = top.exponent % 2 == 0 ? 2 : 3;
    const Wide square = (Wide{top.high} << 64 | top.low) >> shift;
    // The first guess has 53 correct bits. One step of Newton's iteration doubles their number.
    auto root = static_cast<Limb>(std::sqrt(static_cast<double>(square)));
    root = low((root + square / root) / 2);
    while (Wide{root} * root > square) --root;
    Dyadic result;
    result.set(root, (top.exponent + shift) / 2);
    return result;
}

}  // namespace limn
