// Spheres of a block against a ray, in float, several at once. Per-target include guard, as Highway has it.
#if defined(LIMN_KERNELS_SPHERE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_KERNELS_SPHERE_INL_H
#undef LIMN_KERNELS_SPHERE_INL_H
#else
#define LIMN_KERNELS_SPHERE_INL_H
#endif

#include "kernels/lanes-inl.h"
#include "kernels/leaf_rays.h"

HWY_BEFORE_NAMESPACE();
namespace limn::kernels::HWY_NAMESPACE {

// filter_sphere's discriminant in float, and its bound, which tells spheres that are surely missed; others are dropped
// where the whole sphere lies beyond the interval of t. Where the discriminant is beyond its bound the first root is
// off by what filter_sphere says of `outer`, here with the rounding of float and twice over.
template <bool kMoving>
HWY_INLINE Candidates test_spheres(const flat::BlockView& block, std::size_t count, const RoundRay& ray, float time,
                                   float t_min, float t_max) {
    const Lanes d;
    const std::uint32_t* const rows = block.rows(count);
    Candidates found;
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        const auto row = [&](std::size_t r) { return load_floats(rows + r * count + i); };
        const auto seen = [&](std::size_t a) {
            auto center = row(a);
            if constexpr (kMoving) center = hn::MulAdd(hn::Set(d, time), hn::Sub(row(3 + a), center), center);
            return hn::Sub(hn::Sub(center, hn::Set(d, ray.high[a])), hn::Set(d, ray.low[a]));
        };
        const auto radius = row(kMoving ? 6 : 3);
        const auto px = seen(0), py = seen(1), pz = seen(2);
        const auto dx = hn::Set(d, ray.direction[0]), dy = hn::Set(d, ray.direction[1]),
                   dz = hn::Set(d, ray.direction[2]);
        const auto foot_t =
            hn::Mul(hn::MulAdd(px, dx, hn::MulAdd(py, dy, hn::Mul(pz, dz))), hn::Set(d, ray.inverse_squared));
        const auto fx = hn::NegMulAdd(foot_t, dx, px), fy = hn::NegMulAdd(foot_t, dy, py),
                   fz = hn::NegMulAdd(foot_t, dz, pz);
        const auto foot2 = hn::MulAdd(fx, fx, hn::MulAdd(fy, fy, hn::Mul(fz, fz)));
        const auto r2 = hn::Mul(radius, radius);
        const auto reach = hn::Add(hn::Abs(px), hn::Add(hn::Abs(py), hn::Abs(pz)));
        const auto foot_error = hn::MulAdd(hn::Set(d, ray.relative), reach, hn::Set(d, ray.absolute));
        const auto error = hn::MulAdd(foot_error, hn::MulAdd(hn::Set(d, 4.0f), radius, foot_error),
                                      hn::Mul(hn::Set(d, 64 * 0x1p-24f), hn::Add(r2, foot2)));
        const auto missed = hn::Gt(hn::Sub(foot2, r2), error);
        const auto open = hn::AndNot(missed, hn::FirstN(d, count - i));
        if (HWY_LIKELY(hn::AllFalse(d, open))) continue;

        const auto half = hn::Mul(hn::MulAdd(hn::Set(d, 1.001f), radius, hn::Mul(hn::Set(d, 4.0f), foot_error)),
                                  hn::Set(d, ray.inverse_length));
        const auto scale = hn::Set(d, ray.t_scale);
        const auto near = hn::Mul(scale, hn::Sub(foot_t, half)), far = hn::Mul(scale, hn::Add(foot_t, half));
        const auto dropped = hn::Or(hn::Gt(near, hn::Set(d, t_max)), hn::Lt(far, hn::Set(d, t_min)));

        const auto discriminant = hn::Sub(r2, foot2);
        const auto certain = hn::Gt(discriminant, error);
        const auto half_chord = hn::Sqrt(hn::Mul(discriminant, hn::Set(d, ray.inverse_squared)));
        const auto relative = hn::Add(hn::Div(error, discriminant), hn::Set(d, ray.relative));
        const auto root = hn::Sub(foot_t, half_chord);
        const auto root_error =
            hn::MulAdd(foot_error, hn::Set(d, 2 * ray.inverse_length),
                       hn::MulAdd(hn::Mul(hn::Set(d, 2.0f), half_chord), relative,
                                  hn::Mul(hn::Set(d, 16 * 0x1p-24f), hn::Add(hn::Abs(foot_t), half_chord))));
        const auto first = hn::Mul(scale, hn::Sub(root, root_error)), last = hn::Mul(scale, hn::Add(root, root_error));
        found.add(hn::AndNot(dropped, open), certain, hn::IfThenElse(certain, first, near),
                  hn::IfThenElse(certain, last, far), i);
    }
    return found;
}

}  // namespace limn::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
