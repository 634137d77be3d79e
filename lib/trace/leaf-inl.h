// Tests of one ray against the primitives of a block, in float. The include guard is per target, as Highway requires.
#if defined(LIMN_TRACE_LEAF_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_TRACE_LEAF_INL_H
#undef LIMN_TRACE_LEAF_INL_H
#else
#define LIMN_TRACE_LEAF_INL_H
#endif

#include "flat/tree.h"
#include "geometry/planar_float-inl.h"
#include "geometry/sphere_float-inl.h"
#include "trace/walk_ray.h"

HWY_BEFORE_NAMESPACE();
namespace limn::trace::HWY_NAMESPACE {

using namespace limn::HWY_NAMESPACE;
namespace hn = hwy::HWY_NAMESPACE;

// Vectors of eight floats, or of fewer if the processor has no such vectors.
using Lanes = hn::CappedTag<float, flat::kWidth>;
using V = hn::Vec<Lanes>;
using M = hn::Mask<Lanes>;

HWY_INLINE std::uint32_t bits(M mask) { return bits(limn::HWY_NAMESPACE::WideMask<Lanes>{mask}); }

using Floats = Wide<Lanes>;

// Returns the numbers of a ray, each in all lanes.
template <template <class> class RayNumbers>
HWY_INLINE RayNumbers<Floats> in_all_lanes(const float* numbers) {
    return RayNumbers<Floats>::from([&](std::size_t i) HWY_ATTR { return Floats(numbers[i]); });
}

// The result of a test of a block.
struct Candidates {
    std::uint32_t possible = 0, certain = 0;                      // bit i: the ray may hit, or surely hits, primitive i
    HWY_ALIGN float near[flat::kMaxBlock], far[flat::kMaxBlock];  // bounds on t

    HWY_INLINE void add(const FloatHits<Floats>& hits, std::size_t at) {
        possible |= bits(hits.possible) << at;
        certain |= bits(hits.certain & hits.possible) << at;
        store(hits.near, near + at);
        store(hits.far, far + at);
    }
};

// Returns the lanes that hold a primitive, from lane i of a block on. `ids` is its row of ids.
HWY_INLINE Mask<Floats> lanes_there(const float* ids, std::size_t i) {
    const hn::RebindToUnsigned<Lanes> d;
    const auto bits_of = hn::BitCast(d, hn::Load(Lanes(), ids + i));
    return {hn::RebindMask(Lanes(), hn::Ne(bits_of, hn::Set(d, flat::kNothing)))};
}

template <bool kQuad>
HWY_INLINE Candidates test_planar(const flat::BlockView& block, const WalkRay& ray, float t_min, float t_max) {
    const float *const x = block.row(ray.rows[0]), *const y = block.row(ray.rows[1]), *const z = block.row(ray.rows[2]);
    Candidates found;
    for (std::size_t i = 0; i < flat::kMaxBlock; i += kLanes<Floats>) {
        const auto vertex = [&](std::size_t k) HWY_ATTR {
            const std::size_t at = 3 * k * flat::kWidth + i;
            return Vector<Floats>{load<Floats>(x + at), load<Floats>(y + at), load<Floats>(z + at)};
        };
        const auto there = lanes_there(block.ids(kQuad ? flat::Form::quads : flat::Form::triangles), i);
        const auto hits = test_planar<kQuad>(vertex, in_all_lanes<PlanarFloatRay>(ray.planar), there,
                                             ray.excludes_behind, {t_min, t_max});
        if (any(hits.possible)) found.add(hits, i);
    }
    return found;
}

template <bool kMoving>
HWY_INLINE Candidates test_spheres(const flat::BlockView& block, const WalkRay& ray, float time, float t_min,
                                   float surely_after, float t_max) {
    Candidates found;
    for (std::size_t i = 0; i < flat::kMaxBlock; i += kLanes<Floats>) {
        const auto row = [&](std::size_t r) HWY_ATTR { return load<Floats>(block.row(r) + i); };
        const auto coordinate = [&](std::size_t a) HWY_ATTR {
            const Floats at0 = row(a);
            if constexpr (kMoving) return mul_add(time, row(3 + a) - at0, at0);
            return at0;
        };
        auto here = in_all_lanes<SphereFloatRay>(ray.round);
        here.absolute = here.absolute + row(kMoving ? 7 : 4);
        const auto roots = float_roots(three<Floats>(coordinate, 0), row(kMoving ? 6 : 3), here);
        if (HWY_LIKELY(!any(!roots.missed))) continue;
        auto hits = first_root(roots, Floats(surely_after), {t_min, t_max});
        hits.possible =
            hits.possible & lanes_there(block.ids(kMoving ? flat::Form::moving_spheres : flat::Form::spheres), i);
        found.add(hits, i);
    }
    return found;
}

}  // namespace limn::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
