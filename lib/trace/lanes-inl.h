// What the searches share: the floats of a node or a block in a vector. Per-target include guard, as Highway has it.
#if defined(LIMN_TRACE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_TRACE_LANES_INL_H
#undef LIMN_TRACE_LANES_INL_H
#else
#define LIMN_TRACE_LANES_INL_H
#endif

#include <cstdint>

#include "flat/tree.h"
#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::trace::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Eight floats where the processor has them, else four.
using Lanes = hn::CappedTag<float, flat::kWidth>;
using V = hn::Vec<Lanes>;
using M = hn::Mask<Lanes>;

HWY_INLINE std::uint32_t bits(M mask) { return bits(limn::HWY_NAMESPACE::WideMask<Lanes>{mask}); }

// From a row of a block, whose words stand for floats.
HWY_INLINE V load_floats(const std::uint32_t* words) {
    return hn::BitCast(Lanes(), hn::LoadU(hn::RebindToUnsigned<Lanes>(), words));
}

}  // namespace limn::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
