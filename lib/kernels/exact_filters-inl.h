// The filters of lib/core in vectors of double, to the same bits. Per-target include guard, as Highway has it.
#if defined(LIMN_KERNELS_EXACT_FILTERS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_KERNELS_EXACT_FILTERS_INL_H
#undef LIMN_KERNELS_EXACT_FILTERS_INL_H
#else
#define LIMN_KERNELS_EXACT_FILTERS_INL_H
#endif

#include "kernels/lanes-inl.h"
#include "predicates/coordinate.h"
#include "predicates/filter.h"
#include "predicates/ray_frame.h"
#include "predicates/sheared_ray.h"

HWY_BEFORE_NAMESPACE();
namespace limn::kernels::HWY_NAMESPACE {

// What in_search says of a t that is off by at most `error`.
template <class D, class T = hn::Vec<D>>
struct Judgement {
    hn::Mask<D> beyond, accurate, within;
};
template <class D, class T = hn::Vec<D>>
HWY_INLINE Judgement<D> judge(D d, T t, T error, T t_min, T t_max) {
    Judgement<D> j;
    const auto round = hn::PromoteTo(d, hn::DemoteTo(hn::Rebind<float, D>(), t));
    const auto misses_round = hn::And(hn::Ne(t, round), hn::Le(hn::Abs(hn::Sub(t, round)), error));
    j.accurate = hn::AndNot(misses_round, hn::Le(error, hn::Mul(hn::Set(d, kAccurate), hn::Abs(t))));
    j.beyond = hn::Or(hn::Gt(hn::Sub(t, error), t_max), hn::Lt(hn::Add(t, error), t_min));
    j.within = hn::And(hn::And(hn::Gt(t, t_min), hn::Le(t, t_max)), hn::Lt(t, hn::Set(d, kInfinity)));
    return j;
}

// A ray and a triangle's vertices or a quad's corner and edges in each lane, the axes permuted as ShearedRay has it.
template <class D, class T = hn::Vec<D>>
struct PlanarQuestion {
    T origin[3], direction[3], vertex[9], origin_error, direction_error, t_min, t_max;
};
template <class D, class T = hn::Vec<D>>
struct PlanarAnswers {
    hn::Mask<D> hit, miss;  // neither: not answered here
    T t, u, v;
};

// filter_triangle and filter_quad (predicates/triangle.h, quad.h) for rays that pass inside the edges: the same
// operations in the same order, so that an answer has the same bits. Other rays, and those whose t is not accurate, are
// left to them.
template <bool kQuad, class D>
class PlanarFilter {
public:
    using T = hn::Vec<D>;

    HWY_INLINE static PlanarAnswers<D> answer(D d, const PlanarQuestion<D>& q) {
        const Sheared r(d, q);
        return kQuad ? quad(d, q, r) : triangle(d, q, r);
    }

private:
    // ShearedRay.
    struct Sheared {
        T shear_x, shear_y, relative, absolute, direction_error;

        HWY_INLINE Sheared(D d, const PlanarQuestion<D>& q) {
            const auto along = q.direction[2];
            shear_x = hn::Div(q.direction[0], along), shear_y = hn::Div(q.direction[1], along);
            const auto error = hn::Div(hn::Mul(hn::Set(d, 4.0), q.direction_error), hn::Abs(along));
            direction_error = hn::IfThenElse(hn::Lt(error, hn::Set(d, 0.5)), error, hn::Set(d, kInfinity));
            const auto slack = hn::Set(d, 1 + 0x1p-30);
            relative = hn::Mul(hn::Add(hn::Set(d, 8 * kRoundoff), direction_error), slack);
            absolute = hn::Mul(
                hn::Mul(hn::Mul(hn::Set(d, 2.0), q.origin_error), hn::Add(hn::Set(d, 1.0), direction_error)), slack);
        }
    };

    struct Vertex {
        T x, y, z;
    };
    HWY_INLINE static Vertex edge(const PlanarQuestion<D>& q, std::size_t first) {
        return {q.vertex[first], q.vertex[first + 1], q.vertex[first + 2]};
    }
    HWY_INLINE static Vertex seen(const PlanarQuestion<D>& q, std::size_t first) {
        const Vertex v = edge(q, first);
        return {hn::Sub(v.x, q.origin[0]), hn::Sub(v.y, q.origin[1]), hn::Sub(v.z, q.origin[2])};
    }
    HWY_INLINE static Vertex shear(const Sheared& r, const Vertex& v) {
        return {hn::Sub(v.x, hn::Mul(r.shear_x, v.z)), hn::Sub(v.y, hn::Mul(r.shear_y, v.z)), v.z};
    }
    HWY_INLINE static T cross(T ax, T by, T ay, T bx) { return hn::Sub(hn::Mul(ax, by), hn::Mul(ay, bx)); }
    HWY_INLINE static T largest(const Vertex& a, const Vertex& b, const Vertex& c) {
        return hn::Max(max_abs(a.x, a.y, a.z), hn::Max(max_abs(b.x, b.y, b.z), max_abs(c.x, c.y, c.z)));
    }

    // ShearedRay::determinant_error and coordinate_error.
    struct Errors {
        T coordinate, determinant;
    };
    HWY_INLINE static Errors errors(D d, const Sheared& r, T reach, T across) {
        Errors e;
        e.coordinate = hn::Add(hn::Mul(r.relative, reach), r.absolute);
        const auto product = hn::Mul(hn::Mul(hn::Set(d, 4.0), hn::Add(across, e.coordinate)), e.coordinate);
        const auto is_in_range = hn::And(hn::Gt(reach, hn::Set(d, 0x1p-300)), hn::Lt(reach, hn::Set(d, 0x1p300)));
        e.determinant = hn::IfThenElse(is_in_range, hn::Add(product, hn::Set(d, 0x1p-600)), hn::Set(d, kInfinity));
        return e;
    }

    // planar_answer.
    HWY_INLINE static void judge_plane(D d, const PlanarQuestion<D>& q, const Sheared& r, hn::Mask<D> sure,
                                       T coordinate_error, T weight_error, T depth, T z, PlanarAnswers<D>& a) {
        const auto along = q.direction[2];
        const auto z_error = hn::Add(hn::Mul(hn::Set(d, 2.0), hn::Add(hn::Mul(weight_error, depth), coordinate_error)),
                                     hn::Mul(r.direction_error, hn::Abs(z)));
        a.t = hn::Div(z, along);
        const Judgement<D> j = judge(d, a.t, hn::Div(z_error, hn::Abs(along)), q.t_min, q.t_max);
        const auto accurate = hn::And(j.accurate, hn::Le(weight_error, hn::Set(d, kAccurateWeight)));
        a.miss = hn::And(sure, hn::Or(j.beyond, hn::AndNot(j.within, accurate)));
        a.hit = hn::AndNot(j.beyond, hn::And(sure, hn::And(accurate, j.within)));
    }

    HWY_INLINE static PlanarAnswers<D> triangle(D d, const PlanarQuestion<D>& q, const Sheared& r) {
        const Vertex qa = seen(q, 0), qb = seen(q, 3), qc = seen(q, 6);
        const Vertex pa = shear(r, qa), pb = shear(r, qb), pc = shear(r, qc);
        const auto wa = cross(pc.x, pb.y, pc.y, pb.x), wb = cross(pa.x, pc.y, pa.y, pc.x),
                   wc = cross(pb.x, pa.y, pb.y, pa.x);
        const auto least = hn::Min(wa, hn::Min(wb, wc)), most = hn::Max(wa, hn::Max(wb, wc));
        const auto across = hn::Max(max_abs(pa.x, pb.x, pc.x), max_abs(pa.y, pb.y, pc.y));
        const Errors e = errors(d, r, largest(qa, qb, qc), across);
        const auto sure = hn::Or(hn::Gt(least, e.determinant), hn::Lt(most, hn::Neg(e.determinant)));
        const auto det = hn::Add(hn::Add(wa, wb), wc);
        const auto depth = hn::Sub(hn::Max(pa.z, hn::Max(pb.z, pc.z)), hn::Min(pa.z, hn::Min(pb.z, pc.z)));
        const auto z = hn::Div(hn::Add(hn::Add(hn::Mul(wa, pa.z), hn::Mul(wb, pb.z)), hn::Mul(wc, pc.z)), det);
        const auto weight_error = hn::Div(hn::Mul(hn::Set(d, 5.0), e.determinant), hn::Abs(det));
        PlanarAnswers<D> a;
        a.u = hn::Div(wb, det), a.v = hn::Div(wc, det);
        judge_plane(d, q, r, sure, e.coordinate, weight_error, depth, z, a);
        return a;
    }

    HWY_INLINE static PlanarAnswers<D> quad(D d, const PlanarQuestion<D>& q, const Sheared& r) {
        const Vertex to_corner = seen(q, 0), edge_u = edge(q, 3), edge_v = edge(q, 6);
        const Vertex c = shear(r, to_corner), eu = shear(r, edge_u), ev = shear(r, edge_v);
        auto det = cross(eu.x, ev.y, eu.y, ev.x), wu = cross(ev.x, c.y, ev.y, c.x), wv = cross(c.x, eu.y, c.y, eu.x);
        const auto turned = hn::Lt(det, hn::Zero(d));
        det = hn::IfThenElse(turned, hn::Neg(det), det);
        wu = hn::IfThenElse(turned, hn::Neg(wu), wu), wv = hn::IfThenElse(turned, hn::Neg(wv), wv);
        const auto least = hn::Min(wu, wv), most = hn::Max(wu, wv);
        const auto across = hn::Max(max_abs(c.x, eu.x, ev.x), max_abs(c.y, eu.y, ev.y));
        const Errors e = errors(d, r, largest(to_corner, edge_u, edge_v), across);
        const auto sure =
            hn::And(hn::Gt(least, e.determinant), hn::Gt(hn::Sub(det, most), hn::Mul(hn::Set(d, 3.0), e.determinant)));
        PlanarAnswers<D> a;
        a.u = hn::Div(wu, det), a.v = hn::Div(wv, det);
        const auto z = hn::Add(c.z, hn::Add(hn::Mul(a.u, eu.z), hn::Mul(a.v, ev.z)));
        const auto weight_error = hn::Div(hn::Mul(hn::Set(d, 4.0), e.determinant), det);
        judge_plane(d, q, r, sure, e.coordinate, weight_error, hn::Add(hn::Abs(eu.z), hn::Abs(ev.z)), z, a);
        return a;
    }
};

HWY_INLINE Decision decision(std::uint32_t hits, std::uint32_t misses, std::size_t lane) {
    return (hits >> lane & 1) != 0 ? Decision::hit : (misses >> lane & 1) != 0 ? Decision::miss : Decision::undecided;
}

// The axes as ShearedRay permutes them, without branches.
struct PermutedAxes {
    unsigned of[3];

    explicit HWY_INLINE PermutedAxes(const Vec3& direction) {
        const double x = std::abs(direction.x), y = std::abs(direction.y), z = std::abs(direction.z);
        const unsigned is_x = x > y;
        const unsigned longest = (is_x ? x : y) > z ? 1u - is_x : 2u;
        of[0] = 9u >> (2 * longest) & 3;   // 1 2 0
        of[1] = 18u >> (2 * longest) & 3;  // 2 0 1
        of[2] = longest;
    }
};

// A ray and a sphere in each lane.
template <class D, class T = hn::Vec<D>>
struct SphereQuestion {
    T origin[3], direction[3], center[3], radius, origin_error, direction_error, t_min, t_max;
};
template <class D, class T = hn::Vec<D>>
struct SphereAnswers {
    hn::Mask<D> hit, miss;  // neither: not answered here
    T t;
};

template <class T>
HWY_INLINE T dot3(T ax, T ay, T az, T bx, T by, T bz) {
    return hn::Add(hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by)), hn::Mul(az, bz));
}

// filter_sphere, in the same way as PlanarFilter: the first root within the search.
template <class D>
HWY_INLINE SphereAnswers<D> filter_spheres(D d, const SphereQuestion<D>& q) {
    const auto set = [&](double x) HWY_ATTR { return hn::Set(d, x); };
    const auto dx = q.direction[0], dy = q.direction[1], dz = q.direction[2];
    const auto px = hn::Sub(q.origin[0], q.center[0]), py = hn::Sub(q.origin[1], q.center[1]),
               pz = hn::Sub(q.origin[2], q.center[2]);
    const auto radius = q.radius;
    const auto squared = dot3(dx, dy, dz, dx, dy, dz);
    const auto inverse_length = hn::Div(set(1), max_abs(dx, dy, dz));
    const auto slack = set(1 + 0x1p-30);
    const auto relative =
        hn::Mul(hn::Add(set(10 * kRoundoff), hn::Mul(hn::Mul(set(8), q.direction_error), inverse_length)), slack);
    const auto absolute = hn::Mul(hn::Mul(set(2), q.origin_error), slack);
    const auto reach = hn::Add(hn::Add(hn::Abs(px), hn::Abs(py)), hn::Abs(pz));
    const auto in_range = hn::And(
        hn::And(hn::Gt(squared, set(0x1p-460)), hn::Lt(squared, set(0x1p460))),
        hn::And(hn::Lt(reach, set(0x1p230)), hn::And(hn::Lt(radius, set(0x1p230)), hn::Gt(radius, set(0x1p-230)))));

    const auto foot_t = hn::Div(hn::Neg(dot3(px, py, pz, dx, dy, dz)), squared);
    const auto fx = hn::Add(px, hn::Mul(foot_t, dx)), fy = hn::Add(py, hn::Mul(foot_t, dy)),
               fz = hn::Add(pz, hn::Mul(foot_t, dz));
    const auto r2 = hn::Mul(radius, radius), foot2 = dot3(fx, fy, fz, fx, fy, fz);
    const auto discriminant = hn::Sub(r2, foot2);
    const auto foot_error = hn::Add(hn::Mul(relative, reach), absolute);
    const auto error = hn::Add(hn::Mul(foot_error, hn::Add(hn::Mul(set(4), radius), foot_error)),
                               hn::Mul(set(32 * kRoundoff), hn::Add(r2, foot2)));

    const auto half_chord = hn::Sqrt(hn::Div(discriminant, squared));
    const auto outer = hn::Add(foot_t, hn::CopySign(half_chord, foot_t)), size = hn::Abs(outer);
    const auto outer_error = hn::Add(hn::Add(hn::Mul(foot_error, inverse_length),
                                             hn::Mul(half_chord, hn::Add(hn::Div(error, discriminant), relative))),
                                     hn::Mul(set(4 * kRoundoff), size));
    const auto power = hn::Sub(dot3(px, py, pz, px, py, pz), r2);
    const auto power_error = hn::Add(hn::Mul(set(8 * kRoundoff), hn::Add(hn::Mul(reach, reach), r2)),
                                     hn::Mul(absolute, hn::Add(hn::Mul(set(2), reach), absolute)));
    const auto inner = hn::Div(power, hn::Mul(squared, outer));
    const auto inner_error = hn::Add(
        hn::Mul(hn::Div(power_error, hn::Mul(squared, size)), set(2)),
        hn::Mul(hn::Abs(inner), hn::Add(hn::Mul(set(2), hn::Div(outer_error, size)), hn::Mul(set(2), relative))));
    const auto sure =
        hn::And(in_range, hn::And(hn::Gt(discriminant, error), hn::Le(outer_error, hn::Mul(set(0.25), size))));
    const auto is_outer_first = hn::Lt(outer, inner);
    const auto near = hn::IfThenElse(is_outer_first, outer, inner), far = hn::IfThenElse(is_outer_first, inner, outer);
    const auto t_min = q.t_min, t_max = q.t_max;
    const auto first = judge(d, near, hn::IfThenElse(is_outer_first, outer_error, inner_error), t_min, t_max);
    const auto last = judge(d, far, hn::IfThenElse(is_outer_first, inner_error, outer_error), t_min, t_max);
    const auto is_hit = [](const Judgement<D>& j)
                            HWY_ATTR { return hn::AndNot(j.beyond, hn::And(j.accurate, j.within)); };
    const auto first_hit = is_hit(first);
    const auto first_miss = hn::Or(first.beyond, hn::AndNot(first.within, first.accurate));
    const auto last_miss = hn::Or(last.beyond, hn::AndNot(last.within, last.accurate));
    return {hn::And(sure, hn::Or(first_hit, hn::And(first_miss, is_hit(last)))),
            hn::And(sure, hn::And(first_miss, last_miss)), hn::IfThenElse(first_hit, near, far)};
}

// One question alone; unsure: not answered here.
HWY_INLINE Decision settle_one(const RayFrame& frame, const Search& search, const Point3& center, double radius,
                               PlanarHit& hit) {
    const hn::CappedTag<double, 1> d;
    const Ray& ray = frame.ray;
    SphereQuestion<hn::CappedTag<double, 1>> q;
    for (std::size_t a = 0; a < 3; ++a)
        q.origin[a] = hn::Set(d, ray.origin[a]), q.direction[a] = hn::Set(d, ray.direction[a]),
        q.center[a] = hn::Set(d, center[a]);
    q.radius = hn::Set(d, radius);
    q.origin_error = hn::Set(d, frame.origin_error), q.direction_error = hn::Set(d, frame.direction_error);
    q.t_min = hn::Set(d, search.t_min), q.t_max = hn::Set(d, search.t_max);
    const auto answers = filter_spheres(d, q);
    hit = {hn::GetLane(answers.t), 0, 0};
    return decision(bits(d, answers.hit), bits(d, answers.miss), 0);
}

template <bool kQuad, class A, class B>
HWY_INLINE Decision settle_one(const RayFrame& frame, const Search& search, const A& a, const B& b, const B& c,
                               PlanarHit& hit) {
    const hn::CappedTag<double, 1> d;
    const PermutedAxes axes(frame.ray.direction);
    PlanarQuestion<hn::CappedTag<double, 1>> q;
    for (std::size_t k = 0; k < 3; ++k) {
        const unsigned axis = axes.of[k];
        q.origin[k] = hn::Set(d, coordinate(frame.ray.origin, axis));
        q.direction[k] = hn::Set(d, coordinate(frame.ray.direction, axis));
        q.vertex[k] = hn::Set(d, coordinate(a, axis));
        q.vertex[3 + k] = hn::Set(d, coordinate(b, axis));
        q.vertex[6 + k] = hn::Set(d, coordinate(c, axis));
    }
    q.origin_error = hn::Set(d, frame.origin_error), q.direction_error = hn::Set(d, frame.direction_error);
    q.t_min = hn::Set(d, search.t_min), q.t_max = hn::Set(d, search.t_max);
    const auto answers = PlanarFilter<kQuad, hn::CappedTag<double, 1>>::answer(d, q);
    hit = {hn::GetLane(answers.t), hn::GetLane(answers.u), hn::GetLane(answers.v)};
    return decision(bits(d, answers.hit), bits(d, answers.miss), 0);
}

}  // namespace limn::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
