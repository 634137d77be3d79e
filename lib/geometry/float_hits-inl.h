// The results of tests in float. The include guard is per target, as Highway requires.
#if defined(LIMN_GEOMETRY_FLOAT_HITS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_GEOMETRY_FLOAT_HITS_INL_H
#undef LIMN_GEOMETRY_FLOAT_HITS_INL_H
#else
#define LIMN_GEOMETRY_FLOAT_HITS_INL_H
#endif

#include "geometry/ray_of-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

// The result of a float test.
template <class N>
struct FloatHits {
    Mask<N> possible;  // the shape may be hit within the search
    Mask<N> certain;   // the ray surely hits the shape between near and far, which may be outside the search
    N near, far;       // bounds on t
};

// These return t moved up and down by more than the sum of two errors: the rounding of t to float, and the error of the
// t that will be reported.
HWY_INLINE float above(float t) { return t * (t > 0 ? 1 + 0x1p-22f : 1 - 0x1p-22f); }
HWY_INLINE float below(float t) { return t * (t > 0 ? 1 - 0x1p-22f : 1 + 0x1p-22f); }
template <class N>
HWY_INLINE N above(N t) {
    return mul_add(0x1p-22f, abs(t), t);
}
template <class N>
HWY_INLINE N below(N t) {
    return neg_mul_add(0x1p-22f, abs(t), t);
}

}  // namespace limn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
