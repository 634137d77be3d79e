// BoxRay in vectors. Per-target include guard, as Highway has it.
#if defined(LIMN_TRACE_BOX_RAY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_TRACE_BOX_RAY_INL_H
#undef LIMN_TRACE_BOX_RAY_INL_H
#else
#define LIMN_TRACE_BOX_RAY_INL_H
#endif

#include <cstddef>

#include "trace/box_ray.h"
#include "trace/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::trace::HWY_NAMESPACE {

// The four doubles that begin `offset` bytes into a ray. As bytes: they are no array.
template <std::size_t kOffset, class D>
HWY_INLINE hn::Vec<D> load_from(D d, const Ray& ray) {
    static_assert(kOffset + 4 * sizeof(double) <= sizeof(Ray));
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(&ray);
    return hn::BitCast(d, hn::LoadU(hn::Repartition<std::uint8_t, D>(), bytes + kOffset));
}

// `ray` is what frame.ray holds: where it has just been copied to it cannot be loaded from at once; nor can `out`,
// whose parts are stored one by one, be copied.
HWY_INLINE void set_up(const Ray& ray, const RayFrame& frame, const flat::Blas& blas, BoxRay& out) {
#if HWY_MAX_BYTES >= 32
    const hn::FixedTag<double, 4> wide;
    const hn::FixedTag<float, 4> d;
    const auto origin = load_from<offsetof(Ray, origin)>(wide, ray);
    const auto high = hn::DemoteTo(d, origin);
    const auto direction = hn::DemoteTo(d, load_from<offsetof(Ray, direction)>(wide, ray));
    hn::Store(high, d, out.high);
    hn::Store(direction, d, out.direction);
    hn::Store(hn::DemoteTo(d, hn::Sub(origin, hn::PromoteTo(wide, high))), d, out.low);
    float wider = 0;
    if (HWY_UNLIKELY(!out.is_ordinary(frame, blas, wider))) return out.adapt(frame, blas);
    const auto least = hn::Set(d, BoxRay::kLeast);
    const auto inverse = hn::Div(hn::Set(d, 1.0f), hn::CopySign(hn::Max(hn::Abs(direction), least), direction));
    const auto shift = hn::Neg(hn::Mul(high, inverse));
    const auto widening = hn::Mul(hn::Set(d, wider), hn::Abs(inverse));
    hn::Store(inverse, d, out.inverse);
    hn::Store(hn::Sub(shift, widening), d, out.near_shift);
    hn::Store(hn::Add(shift, widening), d, out.far_shift);
    std::uint8_t signs = 0;
    hn::StoreMaskBits(d, hn::MaskFromVec(hn::And(direction, hn::SignBit(d))), &signs);
    out.octant = signs & 7u;
    out.t_min = out.lower(ray.t_min);
#else
    static_cast<void>(ray);
    out.adapt(frame, blas);
#endif
}

}  // namespace limn::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
