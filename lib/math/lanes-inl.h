// Numbers in lanes. A formula is written once, as a template over the kind of number N: double, or a vector of doubles
// or floats (Wide). Comparisons of two N give a Mask<N>: bool, or one truth value for each lane (WideMask). The include
// guard is per target, as Highway requires.
#if defined(LIMN_MATH_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_MATH_LANES_INL_H
#undef LIMN_MATH_LANES_INL_H
#else
#define LIMN_MATH_LANES_INL_H
#endif

#include <hwy/highway.h>

#include <cmath>
#include <cstdint>
#include <utility>

// Inlines a function in builds without optimisation too, which HWY_INLINE does not. Friends that are defined in class
// templates need this: g++ does not compile them for the instruction set of the target.
#ifndef LIMN_ALWAYS_INLINE
#define LIMN_ALWAYS_INLINE inline __attribute__((always_inline))
#endif

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class D>
struct Wide;

// A truth value for each lane of a Wide<D>. D is Highway's tag for the type and the number of lanes.
template <class D>
struct WideMask {
    hn::Mask<D> m;

    friend LIMN_ALWAYS_INLINE Wide<D> select(WideMask mask, Wide<D> yes, Wide<D> no) {
        return hn::IfThenElse(mask.m, yes.v, no.v);
    }
    friend LIMN_ALWAYS_INLINE WideMask select(WideMask mask, WideMask yes, WideMask no) {
        return (mask & yes) | ((!mask) & no);
    }

    friend LIMN_ALWAYS_INLINE WideMask operator&(WideMask a, WideMask b) { return {hn::And(a.m, b.m)}; }
    friend LIMN_ALWAYS_INLINE WideMask operator|(WideMask a, WideMask b) { return {hn::Or(a.m, b.m)}; }
    friend LIMN_ALWAYS_INLINE WideMask operator^(WideMask a, WideMask b) { return {hn::Xor(a.m, b.m)}; }
    friend LIMN_ALWAYS_INLINE WideMask operator!(WideMask a) { return {hn::Not(a.m)}; }
};

// A vector of numbers, one in each lane.
template <class D>
struct Wide {
    using Tag = D;
    using Scalar = hn::TFromD<D>;

    hn::Vec<D> v;

    Wide() = default;
    HWY_INLINE Wide(hn::Vec<D> lanes) : v(lanes) {}
    HWY_INLINE Wide(Scalar x) : v(hn::Set(D(), x)) {}

    friend LIMN_ALWAYS_INLINE Wide operator+(Wide a, Wide b) { return hn::Add(a.v, b.v); }
    friend LIMN_ALWAYS_INLINE Wide operator-(Wide a, Wide b) { return hn::Sub(a.v, b.v); }
    friend LIMN_ALWAYS_INLINE Wide operator*(Wide a, Wide b) { return hn::Mul(a.v, b.v); }
    friend LIMN_ALWAYS_INLINE Wide operator/(Wide a, Wide b) { return hn::Div(a.v, b.v); }
    friend LIMN_ALWAYS_INLINE Wide operator^(Wide a, Wide b) { return hn::Xor(a.v, b.v); }  // bitwise
    friend LIMN_ALWAYS_INLINE Wide operator-(Wide a) { return hn::Neg(a.v); }
    friend LIMN_ALWAYS_INLINE WideMask<D> operator<(Wide a, Wide b) { return {hn::Lt(a.v, b.v)}; }
    friend LIMN_ALWAYS_INLINE WideMask<D> operator<=(Wide a, Wide b) { return {hn::Le(a.v, b.v)}; }
    friend LIMN_ALWAYS_INLINE WideMask<D> operator>(Wide a, Wide b) { return {hn::Gt(a.v, b.v)}; }
    friend LIMN_ALWAYS_INLINE WideMask<D> operator>=(Wide a, Wide b) { return {hn::Ge(a.v, b.v)}; }
    friend LIMN_ALWAYS_INLINE WideMask<D> operator==(Wide a, Wide b) { return {hn::Eq(a.v, b.v)}; }
    friend LIMN_ALWAYS_INLINE WideMask<D> operator!=(Wide a, Wide b) { return {hn::Ne(a.v, b.v)}; }

    friend LIMN_ALWAYS_INLINE Wide abs(Wide a) { return hn::Abs(a.v); }
    friend LIMN_ALWAYS_INLINE Wide sqrt(Wide a) { return hn::Sqrt(a.v); }
    friend LIMN_ALWAYS_INLINE Wide min(Wide a, Wide b) { return hn::Min(a.v, b.v); }
    friend LIMN_ALWAYS_INLINE Wide max(Wide a, Wide b) { return hn::Max(a.v, b.v); }
    friend LIMN_ALWAYS_INLINE Wide copy_sign(Wide size, Wide sign) { return hn::CopySign(size.v, sign.v); }
    friend LIMN_ALWAYS_INLINE Wide floor(Wide a) { return hn::Floor(a.v); }
    friend LIMN_ALWAYS_INLINE Wide round(Wide a) { return hn::Round(a.v); }
    // Return a b + c, a b - c and c - a b. They round once on processors with fused multiply-add, else twice. Therefore
    // they must not be used for results that have to have the same bits on every processor.
    friend LIMN_ALWAYS_INLINE Wide mul_add(Wide a, Wide b, Wide c) { return hn::MulAdd(a.v, b.v, c.v); }
    friend LIMN_ALWAYS_INLINE Wide mul_sub(Wide a, Wide b, Wide c) { return hn::MulSub(a.v, b.v, c.v); }
    friend LIMN_ALWAYS_INLINE Wide neg_mul_add(Wide a, Wide b, Wide c) { return hn::NegMulAdd(a.v, b.v, c.v); }
};

// A vector of doubles: as many as the processor has lanes for, up to eight.
using Doubles = Wide<hn::CappedTag<double, 8>>;
// The type of comparisons of two N.
template <class N>
using Mask = decltype(std::declval<N>() < std::declval<N>());
// The number of lanes in an N.
template <class N>
inline constexpr std::size_t kLanes = hn::MaxLanes(typename N::Tag());
template <>
inline constexpr std::size_t kLanes<double> = 1;

template <class D>
HWY_INLINE bool any(WideMask<D> mask) {
    return !hn::AllFalse(D(), mask.m);
}
template <class D>
HWY_INLINE bool all(WideMask<D> mask) {
    return hn::AllTrue(D(), mask.m);
}
// Returns the mask as an integer. Bit i is lane i; the first lane is the lowest bit. \pre at most 16 lanes
template <class D>
HWY_INLINE std::uint32_t bits(WideMask<D> mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(D(), mask.m, bytes);
    return bytes[0] | (hn::MaxLanes(D()) > 8 ? std::uint32_t{bytes[1]} << 8 : 0u);
}
// Returns the mask in which lane i is set if bit i is. \pre at most 16 lanes
template <class N>
HWY_INLINE Mask<N> mask_of(std::uint32_t bits) {
    const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8)};
    return {hn::LoadMaskBits(typename N::Tag(), bytes)};
}
// Returns the mask of the first `count` lanes, or of all if `count` is larger.
template <class N>
HWY_INLINE Mask<N> first_lanes(std::size_t count) {
    return {hn::FirstN(typename N::Tag(), count)};
}
// Loads kLanes<N> numbers. The address need not be aligned.
template <class N>
HWY_INLINE N load(const typename N::Scalar* from) {
    return hn::LoadU(typename N::Tag(), from);
}
// Loads kLanes<N> doubles and rounds them to float. N is a vector of floats.
template <class N>
HWY_INLINE N load_rounded(const double* from) {
#if HWY_TARGET == HWY_SCALAR
    return N(static_cast<float>(*from));
#else
    const typename N::Tag d;
    const hn::Half<typename N::Tag> half;
    const hn::Rebind<double, hn::Half<typename N::Tag>> doubles;
    return hn::Combine(d, hn::DemoteTo(half, hn::LoadU(doubles, from + kLanes<N> / 2)),
                       hn::DemoteTo(half, hn::LoadU(doubles, from)));
#endif
}
// Stores all lanes. The address need not be aligned.
template <class D>
HWY_INLINE void store(Wide<D> x, hn::TFromD<D>* to) {
    hn::StoreU(x.v, D(), to);
}
// These three return the number in the first lane, the smallest and the largest of all lanes.
template <class D>
HWY_INLINE hn::TFromD<D> first_of_lanes(Wide<D> x) {
    return hn::GetLane(x.v);
}
template <class D>
HWY_INLINE hn::TFromD<D> min_of_lanes(Wide<D> x) {
    return hn::GetLane(hn::MinOfLanes(D(), x.v));
}
template <class D>
HWY_INLINE hn::TFromD<D> max_of_lanes(Wide<D> x) {
    return hn::GetLane(hn::MaxOfLanes(D(), x.v));
}
// Returns x, as doubles, with each lane rounded to the nearest float.
template <class D>
HWY_INLINE Wide<D> rounded_to_float(Wide<D> x) {
    return hn::PromoteTo(D(), hn::DemoteTo(hn::Rebind<float, D>(), x.v));
}

// The same functions for one double and for bool, its mask.
HWY_INLINE double select(bool mask, double yes, double no) { return mask ? yes : no; }
HWY_INLINE bool select(bool mask, bool yes, bool no) { return mask ? yes : no; }
HWY_INLINE bool any(bool mask) { return mask; }
HWY_INLINE bool all(bool mask) { return mask; }
HWY_INLINE double abs(double a) { return std::abs(a); }
HWY_INLINE double sqrt(double a) { return std::sqrt(a); }
HWY_INLINE double min(double a, double b) { return a < b ? a : b; }
HWY_INLINE double max(double a, double b) { return a > b ? a : b; }
HWY_INLINE double copy_sign(double size, double sign) { return std::copysign(size, sign); }
HWY_INLINE double floor(double a) { return std::floor(a); }
HWY_INLINE double round(double a) { return std::nearbyint(a); }
HWY_INLINE double rounded_to_float(double x) { return static_cast<double>(static_cast<float>(x)); }

// Three coordinates: a point, a direction or a normal.
template <class N>
struct Vector {
    N x, y, z;

    friend LIMN_ALWAYS_INLINE Vector operator+(const Vector& a, const Vector& b) {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    friend LIMN_ALWAYS_INLINE Vector operator-(const Vector& a, const Vector& b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    friend LIMN_ALWAYS_INLINE Vector operator*(const N& s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }
    friend LIMN_ALWAYS_INLINE Vector operator*(const Vector& a, const Vector& b) {
        return {a.x * b.x, a.y * b.y, a.z * b.z};
    }
    friend LIMN_ALWAYS_INLINE Vector operator/(const Vector& a, const N& s) { return {a.x / s, a.y / s, a.z / s}; }
    friend LIMN_ALWAYS_INLINE Vector operator-(const Vector& a) { return {-a.x, -a.y, -a.z}; }
    friend LIMN_ALWAYS_INLINE Vector abs(const Vector& a) { return {abs(a.x), abs(a.y), abs(a.z)}; }
    friend LIMN_ALWAYS_INLINE N length_squared(const Vector& a) { return dot(a, a); }
    // Returns the unit vector along `a`, as limn::normalize does. \pre the length is finite and not 0, whether its
    // square is a double or not
    friend LIMN_ALWAYS_INLINE Vector normalize(const Vector& a) {
        const N squared = length_squared(a);
        const Mask<N> extreme = !((squared > N(1e-200)) & (squared < N(1e200)));
        const Vector unit = a / sqrt(squared);
        if (!any(extreme)) return unit;
        const Vector scaled = select(squared > N(1.0), N(0x1p-700), N(0x1p700)) * a;
        return select(extreme, scaled / sqrt(length_squared(scaled)), unit);
    }
    friend LIMN_ALWAYS_INLINE Vector select(const Mask<N>& mask, const Vector& yes, const Vector& no) {
        return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
    }
    friend LIMN_ALWAYS_INLINE N dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
    friend LIMN_ALWAYS_INLINE Vector cross(const Vector& a, const Vector& b) {
        return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    }
    friend LIMN_ALWAYS_INLINE N max_abs(const Vector& a) { return max(abs(a.x), max(abs(a.y), abs(a.z))); }
    friend LIMN_ALWAYS_INLINE N sum_abs(const Vector& a) { return abs(a.x) + abs(a.y) + abs(a.z); }
};

// Returns a point, direction or normal `v` in all lanes.
template <class N, class Three>
HWY_INLINE Vector<N> broadcast(const Three& v) {
    return {N(v.x), N(v.y), N(v.z)};
}

}  // namespace limn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
