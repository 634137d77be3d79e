// Compression of vectors: the lanes that a mask selects are moved to the front. The include guard is per target, as
// Highway requires.
#if defined(LIMN_MATH_COMPRESS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_MATH_COMPRESS_INL_H
#undef LIMN_MATH_COMPRESS_INL_H
#else
#define LIMN_MATH_COMPRESS_INL_H
#endif

#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

// Compress<N> is a function that moves the lanes which a mask selects to the front, in order. The lanes behind them are
// unspecified. hn::Compress of Highway 1.0.3 is avoided in two cases, eight floats with AVX2 and eight doubles with
// AVX-512: g++ copies its tables to the stack on each use.
#if HWY_TARGET == HWY_AVX2

// A table: of[mask] lists the numbers of the lanes that are set in a mask of eight lanes, in ascending order.
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
    // Eight floats are eight words of 32 bits; four doubles are eight words too, two for each lane.
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
    hn::Vec<hn::RebindToSigned<Words>> order_;  // for each word of the result, the index of the word to move there
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
