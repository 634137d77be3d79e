// What the kernels share. Per-target include guard, as Highway has it.
#if defined(LIMN_KERNELS_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_KERNELS_LANES_INL_H
#undef LIMN_KERNELS_LANES_INL_H
#else
#define LIMN_KERNELS_LANES_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "flat/tree.h"

HWY_BEFORE_NAMESPACE();
namespace limn::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Eight floats where the processor has them, else four.
using Lanes = hn::CappedTag<float, flat::kWidth>;
using V = hn::Vec<Lanes>;
using M = hn::Mask<Lanes>;

// Of up to 16 lanes.
template <class D>
HWY_INLINE std::uint32_t bits(D d, hn::Mask<D> mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, mask, bytes);
    return bytes[0] | (hn::MaxLanes(D()) > 8 ? std::uint32_t{bytes[1]} << 8 : 0u);
}
HWY_INLINE std::uint32_t bits(M mask) { return bits(Lanes(), mask); }

// From a row of a block, whose words stand for floats.
HWY_INLINE V load_floats(const std::uint32_t* words) {
    return hn::BitCast(Lanes(), hn::LoadU(hn::RebindToUnsigned<Lanes>(), words));
}

template <class T>
HWY_INLINE T max_abs(T a, T b, T c) {
    return hn::Max(hn::Abs(a), hn::Max(hn::Abs(b), hn::Abs(c)));
}

// t, beyond what rounding to float and what is reported may be off by.
HWY_INLINE float above(float t) { return t * (t > 0 ? 1 + 0x1p-22f : 1 - 0x1p-22f); }
HWY_INLINE float below(float t) { return t * (t > 0 ? 1 - 0x1p-22f : 1 + 0x1p-22f); }

// Primitives of a block that the ray may hit, or hits for sure, by bit, and bounds on the t of each.
struct Candidates {
    std::uint32_t open = 0, certain = 0;
    HWY_ALIGN float near[flat::kMaxBlock], far[flat::kMaxBlock];

    HWY_INLINE void add(M is_open, M is_certain, V t_near, V t_far, std::size_t at) {
        const Lanes d;
        const std::uint32_t these = bits(is_open);
        open |= these << at;
        certain |= (bits(is_certain) & these) << at;
        hn::StoreU(t_near, d, near + at);
        hn::StoreU(t_far, d, far + at);
    }
};

}  // namespace limn::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
