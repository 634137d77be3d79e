// What shading in lanes shares. Per-target include guard, as Highway has it.
#if defined(LIMN_SHADE_DOUBLES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_SHADE_DOUBLES_INL_H
#undef LIMN_SHADE_DOUBLES_INL_H
#else
#define LIMN_SHADE_DOUBLES_INL_H
#endif

#include "lanes/lanes-inl.h"
#include "limn/core/vec.h"
#include "sampling/warps-inl.h"
#include "shade/lobes.h"

HWY_BEFORE_NAMESPACE();
namespace limn::shade::HWY_NAMESPACE {

using namespace limn::HWY_NAMESPACE;
using namespace sampling::HWY_NAMESPACE;

// Those of as many paths as there are lanes, from the i-th on.
HWY_INLINE Vector<Doubles> load3(const Lanes3& lanes, std::size_t i) {
    return {load<Doubles>(lanes.x + i), load<Doubles>(lanes.y + i), load<Doubles>(lanes.z + i)};
}
HWY_INLINE void store3(const Vector<Doubles>& v, Lanes3& lanes, std::size_t i) {
    store(v.x, lanes.x + i), store(v.y, lanes.y + i), store(v.z, lanes.z + i);
}

// Where limn::normalize divides by the length at once; elsewhere it is not for vectors.
HWY_INLINE Mask<Doubles> is_ordinary(Doubles squared_length) {
    return (squared_length > 1e-200) & (squared_length < 1e200);
}

}  // namespace limn::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
