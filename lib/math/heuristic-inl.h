// The weights of multiple importance sampling for two techniques that can draw the same direction. The include guard is
// per target, as Highway requires.
#if defined(LIMN_MATH_HEURISTIC_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_MATH_HEURISTIC_INL_H
#undef LIMN_MATH_HEURISTIC_INL_H
#else
#define LIMN_MATH_HEURISTIC_INL_H
#endif

#include "limn/math/math.h"
#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::sampling::HWY_NAMESPACE {

using namespace limn::HWY_NAMESPACE;

// Returns the weight of the technique with pdf a, combined with a technique with pdf b, by Veach's power heuristic with
// exponent 2 (Robust Monte Carlo Methods for Light Transport Simulation, 1997, section 9.2.4). The weight is 1 if a is
// infinite.
template <class N>
HWY_INLINE N power_heuristic(N a, N b) {
    const N ratio = b / a;
    return select(a < kInfinity, 1.0 / (1.0 + ratio * ratio), 1.0);
}

}  // namespace limn::sampling::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
