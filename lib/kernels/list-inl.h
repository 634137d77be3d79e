// All primitives of a small scene, rays side by side. Per-target include guard, as Highway has it.
#if defined(LIMN_KERNELS_LIST_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_KERNELS_LIST_INL_H
#undef LIMN_KERNELS_LIST_INL_H
#else
#define LIMN_KERNELS_LIST_INL_H
#endif

#include "flat/list.h"
#include "kernels/leaf-inl.h"
#include "predicates/filter.h"

HWY_BEFORE_NAMESPACE();
namespace limn::kernels::HWY_NAMESPACE {

using flat::PrimitiveList;

// A ray, or one in each lane, in float. With u = 2^-24 and coordinates no larger than R = |origin| + extent:
//
// The plane n.x = k, |n| <= 1 along each axis, is met at t = a / b, a = k - n.o, b = n.d. a is off by 16 u R, b by 16 u
// D, D the largest coordinate of d; where |b| > 2^-15 D, so is t by (16 u R + 16 u D |t|) / (|b| - 16 u D) and 2 u |t|
// of its own, of D that is at most u T (17 s + 2), T = R + |t| D, s = D / |b|. The point o + t d is off by that and 3 u
// T, the weights u.x - k' by what the point is off and 8 u T, times the sum of the magnitudes of u: by that sum times G
// = u T (17 s + 11).
template <class D, class T = hn::Vec<D>>
struct LaneRay {
    T ox, oy, oz, dx, dy, dz;
    T reach, size, inverse_size;  // R, D, 1 / D
    T inverse_squared;            // of the length: of scenes with spheres
};

// Where planes are met.
template <class D, class T = hn::Vec<D>>
struct ListedPlane {
    hn::Mask<D> missed, certain, known;  // beside, or inside whatever t is; whether anything is known of t
    T near, far, along;                  // bounds on t; n.d
};

// `row(r)`: a row of PrimitiveList, of one primitive or of one in each lane.
template <class D, class Row>
HWY_INLINE ListedPlane<D> meet_listed(D d, const Row& row, hn::Mask<D> is_triangle, const LaneRay<D>& ray) {
    using List = PrimitiveList;
    constexpr float kUlp = 0x1p-24f;
    const auto nx = row(List::kNormal), ny = row(List::kNormal + 1), nz = row(List::kNormal + 2);
    const auto a = hn::NegMulAdd(nx, ray.ox, hn::NegMulAdd(ny, ray.oy, hn::NegMulAdd(nz, ray.oz, row(List::kOffset))));
    ListedPlane<D> m;
    m.along = hn::MulAdd(nx, ray.dx, hn::MulAdd(ny, ray.dy, hn::Mul(nz, ray.dz)));
    const auto inverse = hn::Div(hn::Set(d, 1.0f), m.along);
    const auto t = hn::Mul(a, inverse);
    const auto px = hn::MulAdd(t, ray.dx, ray.ox), py = hn::MulAdd(t, ray.dy, ray.oy),
               pz = hn::MulAdd(t, ray.dz, ray.oz);
    const auto weight = [&](std::size_t first, std::size_t offset) HWY_ATTR {
        return hn::MulAdd(row(first), px, hn::MulAdd(row(first + 1), py, hn::MulSub(row(first + 2), pz, row(offset))));
    };
    const auto u = weight(List::kU, List::kUOffset), v = weight(List::kV, List::kVOffset);
    const auto steep = hn::Mul(hn::Abs(inverse), ray.size);
    const auto error = hn::Mul(hn::MulAdd(hn::Abs(t), ray.size, ray.reach),
                               hn::MulAdd(steep, hn::Set(d, 17 * kUlp), hn::Set(d, 11 * kUlp)));
    const auto weight_error = hn::MulAdd(row(List::kSpread), error, hn::Set(d, 8 * kUlp));
    const auto sum = hn::IfThenElse(is_triangle, hn::Add(u, v), hn::Max(u, v));
    const auto outside = hn::Max(hn::Neg(hn::Min(u, v)), hn::Sub(sum, hn::Set(d, 1.0f)));
    m.known = hn::Gt(hn::Abs(m.along), hn::Mul(hn::Set(d, 0x1p-15f), ray.size));
    m.missed = hn::And(m.known, hn::Gt(outside, weight_error));
    m.certain = hn::And(m.known, hn::Lt(outside, hn::Neg(weight_error)));
    const auto t_error = hn::Mul(error, ray.inverse_size);
    m.near = hn::Sub(t, t_error), m.far = hn::Add(t, t_error);
    return m;
}

// The ray as listed spheres see it: see float_roots. A centre seen from the origin is off by u R, R as above, and u of
// itself.
template <class D>
HWY_INLINE SphereFloatRay<Wide<D>> sphere_ray(const LaneRay<D>& ray) {
    using N = Wide<D>;
    constexpr float kUlp = 0x1p-24f;
    return {.high = {ray.ox, ray.oy, ray.oz},
            .low = {N(0.0f), N(0.0f), N(0.0f)},
            .direction = {ray.dx, ray.dy, ray.dz},
            .inverse_squared = ray.inverse_squared,
            .inverse_length = N(ray.inverse_size) * (1 + 0x1p-20f),
            .relative = 48 * kUlp,
            .absolute = 4.01f * kUlp * N(ray.reach),
            .t_scale = 1.0f};
}

}  // namespace limn::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
