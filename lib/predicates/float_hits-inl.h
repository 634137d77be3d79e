// What float tests find. Per-target include guard, as Highway has it.
#if defined(LIMN_PREDICATES_FLOAT_HITS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_PREDICATES_FLOAT_HITS_INL_H
#undef LIMN_PREDICATES_FLOAT_HITS_INL_H
#else
#define LIMN_PREDICATES_FLOAT_HITS_INL_H
#endif

#include "predicates/ray_of-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

// Where a shape may be hit within the search; where it surely is, whatever t; and bounds on t.
template <class N>
struct FloatHits {
    Mask<N> possible, certain;
    N near, far;
};

// t, beyond what rounding to float and what is reported may be off by.
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
