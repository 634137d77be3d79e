// The lanes of a mask, one after the other. Per-target include guard, as Highway has it.
#if defined(LIMN_LANES_COMPRESS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_LANES_COMPRESS_INL_H
#undef LIMN_LANES_COMPRESS_INL_H
#else
#define LIMN_LANES_COMPRESS_INL_H
#endif

#include "lanes/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

// Moves the lanes that a mask has to the front; what follows them is not specified. Not always by Highway: g++ copies the
// tables of its version 1.0.3 (eight floats with AVX2, eight doubles with AVX-512) to the stack on each use.
#if HWY_TARGET == HWY_AVX2

// For each mask of eight lanes those that are set, in order.
struct SetLanes {
    alignas(8) std::uint8_t of[256][8] = {};

    constexpr SetLanes() {
        for (unsigned mask = 0; mask < 256; ++mask)
            for (unsigned lane = 0, next = 0; lane < 8; ++lane)
                if ((mask >> lane & 1) != 0) of[mask][next++] = static_cast<std::uint8_t>(lane);
    }
};
inline constexpr SetLanes kSetLanes;

template <class N>
class Compress {
public:
    HWY_INLINE explicit Compress(Mask<N> lanes) {
        const auto words = hn::MaskFromVec(hn::BitCast(Words(), hn::VecFromMask(D(), lanes.m)));
        const std::uint8_t* const set = kSetLanes.of[bits(WideMask<Words>{words})];
        const hn::RebindToSigned<Words> whole;
        order_ = hn::PromoteTo(whole, hn::Load(hn::Rebind<std::uint8_t, Words>(), set));
    }
    HWY_INLINE N operator()(N x) const {
        const auto order = hn::IndicesFromVec(Words(), order_);
        return hn::BitCast(D(), hn::TableLookupLanes(hn::BitCast(Words(), x.v), order));
    }

private:
    using D = typename N::Tag;
    using Words = hn::Repartition<float, D>;
    static_assert(hn::MaxLanes(Words()) == 8);
    hn::Vec<hn::RebindToSigned<Words>> order_;
};

#else

template <class N>
class Compress {
public:
    HWY_INLINE explicit Compress(Mask<N> lanes) : lanes_(lanes) {}
    HWY_INLINE N operator()(N x) const {
#if HWY_TARGET <= HWY_AVX3
        if constexpr (sizeof(x.v) == 64 && sizeof(typename N::Scalar) == 8)
            return hn::Vec<typename N::Tag>{_mm512_maskz_compress_pd(lanes_.m.raw, x.v.raw)};
#endif
        return hn::Compress(x.v, lanes_.m);
    }

private:
    Mask<N> lanes_;
};

#endif

}  // namespace limn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
