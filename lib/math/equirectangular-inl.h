// Equirectangular maps of all directions, as seen from inside. The direction +y is the upper edge of the map, -z is its
// middle, and +x is to the right of the middle. The include guard is per target, as Highway requires.
#if defined(LIMN_MATH_EQUIRECTANGULAR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_MATH_EQUIRECTANGULAR_INL_H
#undef LIMN_MATH_EQUIRECTANGULAR_INL_H
#else
#define LIMN_MATH_EQUIRECTANGULAR_INL_H
#endif

#include "math/functions-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::sampling::HWY_NAMESPACE {

using namespace limn::HWY_NAMESPACE;

// A point of the map.
template <class N>
struct MapPoint {
    N right;  // distance from the left edge, divided by the map's width
    N down;   // distance from the upper edge, divided by the map's height
};

// Returns MapPoint::down, in [0, 1], for a direction whose angle to +y has this cosine and sine.
template <class N>
HWY_INLINE N map_down(N cosine, N sine) {
    return min(angle_of(SineCosine<N>{sine, cosine}) * (1 / kPi), 1.0);
}

// Returns the point of the map that shows a direction. The direction is given in the map's own axes and may have any
// length but 0. A pole is a whole row of the map; the result is the middle of that row.
template <class N>
HWY_INLINE MapPoint<N> map_point(const Vector<N>& direction) {
    const Vector<N> d = normalize(direction);
    const N across = d.x * d.x + d.z * d.z;
    const N right = 0.5 + angle_of(SineCosine<N>{d.x, -d.z}) * (0.5 / kPi);  // in [0.5, 1.5]
    return {select(across > 0.0, select(right < 1.0, right, right - 1.0), 0.5), map_down(d.y, sqrt(across))};
}

// Returns the unit direction that the map shows at `right` in the row of directions whose angle to +y has this cosine
// and sine.
template <class N>
HWY_INLINE Vector<N> map_direction(N right, N cosine, N sine) {
    const SineCosine<N> turn = sine_cosine_of_turns<N>(right - 0.5);
    return {sine * turn.sine, cosine, -(sine * turn.cosine)};
}

}  // namespace limn::sampling::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
