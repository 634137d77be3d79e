// All primitives of a small scene, rays side by side. Per-target include guard, as Highway has it.
#if defined(LIMN_KERNELS_LIST_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_KERNELS_LIST_INL_H
#undef LIMN_KERNELS_LIST_INL_H
#else
#define LIMN_KERNELS_LIST_INL_H
#endif

#include "flat/list.h"
#include "kernels/lanes-inl.h"
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

// Where spheres are met.
template <class D, class T = hn::Vec<D>>
struct ListedSphere {
    hn::Mask<D> missed, certain;                   // the line, for sure
    T near_first, far_first, near_last, far_last;  // bounds on both roots; all the same two where not certain
};

// As test_spheres. The centre seen from the origin is off by u R, R as above, and u of itself.
template <class D, class Row>
HWY_INLINE ListedSphere<D> meet_sphere(D d, const Row& row, const LaneRay<D>& ray) {
    constexpr float kUlp = 0x1p-24f;
    const auto set = [&](float x) HWY_ATTR { return hn::Set(d, x); };
    const auto px = hn::Sub(row(0), ray.ox), py = hn::Sub(row(1), ray.oy), pz = hn::Sub(row(2), ray.oz);
    const auto radius = row(PrimitiveList::kRadius);
    const auto foot_t =
        hn::Mul(hn::MulAdd(px, ray.dx, hn::MulAdd(py, ray.dy, hn::Mul(pz, ray.dz))), ray.inverse_squared);
    const auto fx = hn::NegMulAdd(foot_t, ray.dx, px), fy = hn::NegMulAdd(foot_t, ray.dy, py),
               fz = hn::NegMulAdd(foot_t, ray.dz, pz);
    const auto foot2 = hn::MulAdd(fx, fx, hn::MulAdd(fy, fy, hn::Mul(fz, fz))), r2 = hn::Mul(radius, radius);
    const auto reach = hn::Add(hn::Abs(px), hn::Add(hn::Abs(py), hn::Abs(pz)));
    const auto foot_error = hn::MulAdd(set(48 * kUlp), reach, hn::Mul(set(4.01f * kUlp), ray.reach));
    const auto error =
        hn::MulAdd(foot_error, hn::MulAdd(set(4), radius, foot_error), hn::Mul(set(64 * kUlp), hn::Add(r2, foot2)));
    const auto discriminant = hn::Sub(r2, foot2);
    ListedSphere<D> m;
    m.missed = hn::Gt(hn::Neg(discriminant), error);
    m.certain = hn::Gt(discriminant, error);
    const auto inverse_length = hn::Mul(ray.inverse_size, set(1 + 0x1p-20f));
    const auto half = hn::Mul(hn::MulAdd(set(1.001f), radius, hn::Mul(set(4), foot_error)), inverse_length);
    const auto half_chord = hn::Sqrt(hn::Mul(discriminant, ray.inverse_squared));
    const auto relative = hn::Add(hn::Div(error, discriminant), set(48 * kUlp));
    const auto root_error = hn::MulAdd(foot_error, hn::Mul(set(2), inverse_length),
                                       hn::MulAdd(hn::Mul(set(2), half_chord), relative,
                                                  hn::Mul(set(16 * kUlp), hn::Add(hn::Abs(foot_t), half_chord))));
    const auto near = hn::Sub(foot_t, half), far = hn::Add(foot_t, half);
    const auto first = hn::Sub(foot_t, half_chord), last = hn::Add(foot_t, half_chord);
    m.near_first = hn::IfThenElse(m.certain, hn::Sub(first, root_error), near);
    m.far_first = hn::IfThenElse(m.certain, hn::Add(first, root_error), far);
    m.near_last = hn::IfThenElse(m.certain, hn::Sub(last, root_error), near);
    m.far_last = hn::IfThenElse(m.certain, hn::Add(last, root_error), far);
    return m;
}

// What an interval of t makes of both roots: the one that is the first within it, if that is certain.
template <class D, class T = hn::Vec<D>>
struct FirstRoot {
    hn::Mask<D> missed, certain;
    T near, far;
};
template <class D, class T = hn::Vec<D>>
HWY_INLINE FirstRoot<D> first_root(D d, const ListedSphere<D>& m, T possible_after, T certain_after, T certain_before,
                                   T bound) {
    static_cast<void>(d);
    FirstRoot<D> r;
    const auto is_first = hn::And(m.certain, hn::Gt(m.near_first, certain_after));
    const auto is_behind = hn::And(m.certain, hn::Lt(m.far_first, possible_after));
    r.near = hn::IfThenElse(is_behind, m.near_last, m.near_first);
    r.far = hn::IfThenElse(is_first, m.far_first, m.far_last);
    const auto is_last = hn::And(is_behind, hn::Gt(m.near_last, certain_after));
    r.certain = hn::And(hn::Or(is_first, is_last), hn::Lt(r.far, certain_before));
    r.missed = hn::Or(m.missed, hn::Or(hn::Gt(r.near, bound), hn::Lt(r.far, possible_after)));
    return r;
}

}  // namespace limn::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
