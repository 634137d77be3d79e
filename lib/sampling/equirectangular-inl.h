// Equirectangular maps of all directions, seen from inside: up is the upper edge, -z the middle, +x to the right of it.
// Per-target include guard, as Highway has it.
#if defined(LIMN_SAMPLING_EQUIRECTANGULAR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_SAMPLING_EQUIRECTANGULAR_INL_H
#undef LIMN_SAMPLING_EQUIRECTANGULAR_INL_H
#else
#define LIMN_SAMPLING_EQUIRECTANGULAR_INL_H
#endif

#include "lanes/functions-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::sampling::HWY_NAMESPACE {

using namespace limn::HWY_NAMESPACE;

// A point of the map: the share of its width from the left, and of its height from the top.
template <class N>
struct MapPoint {
    N right, down;
};

// From the angle to +y; within [0, 1].
template <class N>
HWY_INLINE N map_down(N cosine, N sine) {
    return min(angle_of(SineCosine<N>{sine, cosine}) * (1 / kPi), 1.0);
}

// Of a direction of any length in the map's own axes. At the poles, which are a row, it is the middle.
template <class N>
HWY_INLINE MapPoint<N> map_point(const Vector<N>& direction) {
    const Vector<N> d = normalize(direction);
    const N across = d.x * d.x + d.z * d.z;
    const N right = 0.5 + angle_of(SineCosine<N>{d.x, -d.z}) * (0.5 / kPi);  // from 0.5 to 1.5
    return {select(across > 0.0, select(right < 1.0, right, right - 1.0), 0.5), map_down(d.y, sqrt(across))};
}

// The unit direction, where the cosine of its angle to +y says how far down it is.
template <class N>
HWY_INLINE Vector<N> map_direction(N right, N cosine, N sine) {
    const SineCosine<N> turn = sine_cosine_of_turns<N>(right - 0.5);
    return {sine * turn.sine, cosine, -(sine * turn.cosine)};
}

}  // namespace limn::sampling::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
