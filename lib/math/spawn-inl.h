// Origins of rays that leave surfaces. The include guard is per target, as Highway requires.
#if defined(LIMN_MATH_SPAWN_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_MATH_SPAWN_INL_H
#undef LIMN_MATH_SPAWN_INL_H
#else
#define LIMN_MATH_SPAWN_INL_H
#endif

#include <bit>
#include <limits>

#include "limn/math/math.h"
#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

// Returns the next double after x, which is longer or shorter than x. \pre x is finite and not 0
HWY_INLINE double neighbour(double x, bool longer) {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) + (longer ? 1 : ~std::uint64_t{0}));
}
template <class D>
HWY_INLINE Wide<D> neighbour(Wide<D> x, WideMask<D> longer) {
    const hn::Rebind<std::int64_t, D> whole;
    const auto step = hn::IfThenElse(hn::RebindMask(whole, longer.m), hn::Set(whole, 1), hn::Set(whole, -1));
    return hn::BitCast(D(), hn::Add(hn::BitCast(whole, x.v), step));
}

// Returns the next double after at + by in the direction of `by`, because rounding may have moved the sum the other
// way. If `by` is 0, or the sum is NaN or the infinity of that direction, returns the sum.
template <class N>
HWY_INLINE N add_outward(N at, N by) {
    const N sum = at + by;
    const Mask<N> up = by > 0.0, down = by < 0.0;
    const Mask<N> moves = (up & (sum < kInfinity)) | (down & (sum > -kInfinity));
    const Mask<N> longer = (up & (sum > 0.0)) | (down & (sum < 0.0));
    const N beside_zero = copy_sign(N(std::numeric_limits<double>::denorm_min()), by);
    return select(moves, select(sum == 0.0, beside_zero, neighbour(sum, longer)), sum);
}

// Returns `position`, moved off the surface by its error bound: see offset_origin() in limn/math/surface.h.
template <class N>
HWY_INLINE Vector<N> offset_along(const Vector<N>& position, const Vector<N>& error, const Vector<N>& normal,
                                  const Vector<N>& direction) {
    const N distance = dot(abs(normal), error);
    const Vector<N> by = select(dot(normal, direction) < 0.0, -distance, distance) * normal;
    return {add_outward(position.x, by.x), add_outward(position.y, by.y), add_outward(position.z, by.z)};
}

}  // namespace limn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
