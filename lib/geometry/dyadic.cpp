#include "geometry/dyadic.h"

#include <bit>
#include <cmath>

namespace limn {

namespace {

__extension__ using Wide = unsigned __int128;

std::uint64_t low(Wide x) { return static_cast<std::uint64_t>(x); }
std::uint64_t high(Wide x) { return static_cast<std::uint64_t>(x >> 64); }

}  // namespace

Dyadic::Dyadic(double x) {
    // Take the mantissa and the exponent from the bits of a double.
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const auto biased = static_cast<std::ptrdiff_t>(bits >> 52 & 0x7ff);
    const std::uint64_t fraction = bits & ((std::uint64_t{1} << 52) - 1);
    const bool is_normal = biased != 0;
    set(is_normal ? fraction | std::uint64_t{1} << 52 : fraction, (is_normal ? biased : 1) - 1075);
    negative_ = x < 0;
}

void Dyadic::set(Limb bits, std::ptrdiff_t exponent) {
    exponent_ = exponent >> 6;  // exponent / 64, rounded down
    const Wide shifted = Wide{bits} << (exponent & 63);
    // Drop zero limbs at both ends.
    const bool is_high = low(shifted) == 0;
    exponent_ += is_high ? 1 : 0;
    inline_[0] = is_high ? high(shifted) : low(shifted);
    inline_[1] = high(shifted);
    size_ = bits == 0 ? 0 : is_high || high(shifted) == 0 ? 1 : 2;
}

void Dyadic::trim() {
    // Drop zero limbs at both ends.
    Limb* const first = limbs();
    while (size_ > 0 && first[size_ - 1] == 0) --size_;
    if (size_ > 0 && first[0] == 0) {
        std::size_t zeros = 1;
        while (first[zeros] == 0) ++zeros;
        size_ -= zeros;
        exponent_ += static_cast<std::ptrdiff_t>(zeros);
        for (std::size_t i = 0; i < size_; ++i) first[i] = first[i + zeros];
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

Dyadic Dyadic::sum(const Dyadic& a, const Dyadic& b, bool b_negative) {
    if (a.size_ == 0 || b.size_ == 0) {
        Dyadic copy = a.size_ == 0 ? b : a;
        copy.negative_ = a.size_ == 0 ? b_negative : a.negative_;
        return copy;
    }
    // Copy the limbs of `a` to their places in the sum.
    const std::ptrdiff_t first = std::min(a.exponent_, b.exponent_), last = std::max(a.end(), b.end());
    Dyadic result(static_cast<std::size_t>(last - first + 1), first, a.negative_);
    Limb* const limbs = result.limbs();
    const auto a_place = static_cast<std::size_t>(a.exponent_ - first);
    const auto b_place = static_cast<std::size_t>(b.exponent_ - first);
    const Limb *const of_a = a.limbs(), *const of_b = b.limbs();
    for (std::size_t i = 0; i < a_place; ++i) limbs[i] = 0;
    for (std::size_t i = 0; i < a.size_; ++i) limbs[a_place + i] = of_a[i];
    for (std::size_t i = a_place + a.size_; i < result.size_; ++i) limbs[i] = 0;
    // Add or subtract the magnitude of `b`. Subtraction adds the complement, and 1.
    const bool subtracts = a.negative_ != b_negative;
    const Limb flip = subtracts ? ~Limb{0} : 0;
    Wide carry = subtracts ? 1 : 0;
    for (std::size_t i = b_place; i < result.size_; ++i) {
        const std::size_t k = i - b_place;
        carry += Wide{limbs[i]} + ((k < b.size_ ? of_b[k] : 0) ^ flip);
        limbs[i] = low(carry);
        carry >>= 64;
    }
    // Without a last carry the difference is negative, in two's complement. Negate it then.
    if (subtracts && carry == 0) {
        result.negative_ = !a.negative_;
        Wide up = 1;
        for (std::size_t i = 0; i < result.size_; ++i) {
            up += ~limbs[i];
            limbs[i] = low(up);
            up >>= 64;
        }
    }
    result.trim();
    return result;
}

Dyadic operator*(const Dyadic& a, const Dyadic& b) {
    if (a.size_ == 0 || b.size_ == 0) return {};
    Dyadic product(a.size_ + b.size_, a.exponent_ + b.exponent_, a.negative_ != b.negative_);
    Dyadic::Limb* const limbs = product.limbs();
    const Dyadic::Limb *const of_a = a.limbs(), *const of_b = b.limbs();
    for (std::size_t i = 0; i < b.size_; ++i) limbs[i] = 0;
    for (std::size_t i = 0; i < a.size_; ++i) {
        Wide carry = 0;
        for (std::size_t j = 0; j < b.size_; ++j) {
            carry += Wide{of_a[i]} * of_b[j] + limbs[i + j];
            limbs[i + j] = low(carry);
            carry >>= 64;
        }
        limbs[i + b.size_] = low(carry);
    }
    product.trim();
    return product;
}

double ratio(const LeadingBits& over, const LeadingBits& under) {
    // Divide half of the leading 128 bits of `over` by the leading 64 bits of `under`, which are at least 2^63. The
    // halving makes the quotient fit into 64 bits. The quotient has at least 62 bits.
    const Wide numerator = (Wide{over.high} << 64 | over.low) >> 1;
    const double quotient = static_cast<double>(low(numerator / under.high));
    const std::ptrdiff_t exponent = std::clamp<std::ptrdiff_t>(over.exponent + 1 - (under.exponent + 64), -9999, 9999);
    return std::ldexp(quotient, static_cast<int>(exponent));
}

Dyadic Dyadic::square_root() const {
    if (size_ == 0) return {};
    // Shift the leading bits so that their exponent is even and they are below 2^126. Then the root has at most 63
    // bits.
    const LeadingBits top = leading();
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
