// The exact question for the nearest hit of many rays, side by side. Per-target include guard, as Highway has it.
#if defined(LIMN_KERNELS_WINNERS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_KERNELS_WINNERS_INL_H
#undef LIMN_KERNELS_WINNERS_INL_H
#else
#define LIMN_KERNELS_WINNERS_INL_H
#endif

#include "core/filter.h"
#include "core/ray_frame.h"
#include "core/sheared_ray.h"
#include "kernels/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::kernels::HWY_NAMESPACE {

// filter_triangle and filter_quad (core/intersect_*.h) for rays that are known to hit: the same operations in the same
// order, so that an answer has the same bits. What this does not answer, where t is not accurate or not within the
// search, is left to them. Rays and vertices are kept with their axes permuted as ShearedRay has it.
template <std::size_t kLanes, std::size_t kMost>
class PlanarWinners {
public:
    using Doubles = hn::CappedTag<double, kLanes>;
    using DV = hn::Vec<Doubles>;

    bool is_full() const { return size_ == kMost; }
    bool empty() const { return size_ == 0; }
    std::size_t size() const { return size_; }

    // The next question: a triangle's vertices or a quad's corner and edges. `tag` comes back with the answer.
    template <class A, class B>
    HWY_INLINE void add(const RayFrame& frame, const Search& search, const A& a, const B& b, const B& c,
                        std::uint32_t tag) {
        add(frame.ray, frame.origin_error, frame.direction_error, search, a, b, c, tag);
    }
    template <class A, class B>
    HWY_INLINE void add(const Ray& ray, double origin_error, double direction_error, const Search& search, const A& a,
                        const B& b, const B& c, std::uint32_t tag) {
        const std::size_t i = size_++;
        const double dx = std::abs(ray.direction.x), dy = std::abs(ray.direction.y), dz = std::abs(ray.direction.z);
        const unsigned is_x = dx > dy;
        const unsigned z = (is_x ? dx : dy) > dz ? 1u - is_x : 2u;
        const unsigned axes[3] = {9u >> (2 * z) & 3, 18u >> (2 * z) & 3, z};
        const double* const o = &ray.origin.x;
        const double* const d = &ray.direction.x;
        for (std::size_t k = 0; k < 3; ++k) {
            origin_[k][i] = o[axes[k]];
            direction_[k][i] = d[axes[k]];
            vertex_[k][i] = (&a.x)[axes[k]];
            vertex_[3 + k][i] = (&b.x)[axes[k]];
            vertex_[6 + k][i] = (&c.x)[axes[k]];
        }
        origin_error_[i] = origin_error, direction_error_[i] = direction_error;
        t_min_[i] = search.t_min, t_max_[i] = search.t_max;
        tag_[i] = tag;
    }

    // answer(tag, hit or null) for each in turn; null: not answered here. Empties the list.
    template <bool kQuad, class Answer>
    HWY_INLINE void settle(const Answer& answer) {
        const Doubles d;
        for (std::size_t i = 0; i < size_; i += hn::Lanes(d)) {
            HWY_ALIGN double t[kLanes], u[kLanes], v[kLanes];
            const std::uint32_t hits = kQuad ? quads(i, t, u, v) : triangles(i, t, u, v);
            for (std::size_t k = 0; k < std::min(hn::Lanes(d), size_ - i); ++k) {
                const PlanarHit hit{t[k], u[k], v[k]};
                answer(tag_[i + k], (hits >> k & 1) != 0 ? &hit : nullptr);
            }
        }
        size_ = 0;
    }

private:
    // ShearedRay.
    struct Sheared {
        DV x, y, z, shear_x, shear_y, relative, absolute, direction_error;
    };

    HWY_INLINE DV load(const double* row, std::size_t i) const { return hn::Load(Doubles(), row + i); }

    HWY_INLINE Sheared sheared(std::size_t i) const {
        const Doubles d;
        Sheared r;
        r.x = load(origin_[0], i), r.y = load(origin_[1], i), r.z = load(origin_[2], i);
        const auto along = load(direction_[2], i);
        r.shear_x = hn::Div(load(direction_[0], i), along), r.shear_y = hn::Div(load(direction_[1], i), along);
        const auto error = hn::Div(hn::Mul(hn::Set(d, 4.0), load(direction_error_, i)), hn::Abs(along));
        r.direction_error = hn::IfThenElse(hn::Lt(error, hn::Set(d, 0.5)), error, hn::Set(d, kInfinity));
        const auto slack = hn::Set(d, 1 + 0x1p-30);
        r.relative = hn::Mul(hn::Add(hn::Set(d, 8 * kRoundoff), r.direction_error), slack);
        r.absolute = hn::Mul(
            hn::Mul(hn::Mul(hn::Set(d, 2.0), load(origin_error_, i)), hn::Add(hn::Set(d, 1.0), r.direction_error)),
            slack);
        return r;
    }

    struct Vertex {
        DV x, y, z;
    };
    HWY_INLINE Vertex seen(const Sheared& r, std::size_t first, std::size_t i) const {
        return {hn::Sub(load(vertex_[first], i), r.x), hn::Sub(load(vertex_[first + 1], i), r.y),
                hn::Sub(load(vertex_[first + 2], i), r.z)};
    }
    HWY_INLINE Vertex edge(std::size_t first, std::size_t i) const {
        return {load(vertex_[first], i), load(vertex_[first + 1], i), load(vertex_[first + 2], i)};
    }
    HWY_INLINE static Vertex shear(const Sheared& r, const Vertex& v) {
        return {hn::Sub(v.x, hn::Mul(r.shear_x, v.z)), hn::Sub(v.y, hn::Mul(r.shear_y, v.z)), v.z};
    }
    HWY_INLINE static DV cross(DV ax, DV by, DV ay, DV bx) { return hn::Sub(hn::Mul(ax, by), hn::Mul(ay, bx)); }

    // ShearedRay::determinant_error and coordinate_error.
    struct Errors {
        DV coordinate, determinant;
    };
    HWY_INLINE static Errors errors(const Sheared& r, DV reach, DV across) {
        const Doubles d;
        Errors e;
        e.coordinate = hn::Add(hn::Mul(r.relative, reach), r.absolute);
        const auto product = hn::Mul(hn::Mul(hn::Set(d, 4.0), hn::Add(across, e.coordinate)), e.coordinate);
        const auto is_in_range = hn::And(hn::Gt(reach, hn::Set(d, 0x1p-300)), hn::Lt(reach, hn::Set(d, 0x1p300)));
        e.determinant = hn::IfThenElse(is_in_range, hn::Add(product, hn::Set(d, 0x1p-600)), hn::Set(d, kInfinity));
        return e;
    }

    HWY_INLINE static DV largest(const Vertex& a, const Vertex& b, const Vertex& c) {
        return hn::Max(max_abs(a.x, a.y, a.z), hn::Max(max_abs(b.x, b.y, b.z), max_abs(c.x, c.y, c.z)));
    }

    // planar_answer and in_search, where they answer a hit.
    HWY_INLINE std::uint32_t answers(const Sheared& r, std::size_t i, hn::Mask<Doubles> sure, DV coordinate_error,
                                     DV weight_error, DV depth, DV z, double* t_out) const {
        const Doubles d;
        const auto along = load(direction_[2], i);
        const auto z_error = hn::Add(hn::Mul(hn::Set(d, 2.0), hn::Add(hn::Mul(weight_error, depth), coordinate_error)),
                                     hn::Mul(r.direction_error, hn::Abs(z)));
        const auto t = hn::Div(z, along), error = hn::Div(z_error, hn::Abs(along));
        const hn::Rebind<float, Doubles> df;
        const auto round = hn::PromoteTo(d, hn::DemoteTo(df, t));
        const auto misses_round = hn::And(hn::Ne(t, round), hn::Le(hn::Abs(hn::Sub(t, round)), error));
        const auto accurate = hn::AndNot(misses_round, hn::Le(error, hn::Mul(hn::Set(d, kAccurate), hn::Abs(t))));
        const auto within =
            hn::And(hn::And(hn::Gt(t, load(t_min_, i)), hn::Le(t, load(t_max_, i))), hn::Lt(t, hn::Set(d, kInfinity)));
        const auto weights = hn::Le(weight_error, hn::Set(d, kAccurateWeight));
        hn::Store(t, d, t_out);
        return bits(d, hn::And(hn::And(sure, weights), hn::And(accurate, within)));
    }

    HWY_INLINE std::uint32_t triangles(std::size_t i, double* t, double* u, double* v) const {
        const Doubles d;
        const Sheared r = sheared(i);
        const Vertex qa = seen(r, 0, i), qb = seen(r, 3, i), qc = seen(r, 6, i);
        const Vertex pa = shear(r, qa), pb = shear(r, qb), pc = shear(r, qc);
        const auto wa = cross(pc.x, pb.y, pc.y, pb.x), wb = cross(pa.x, pc.y, pa.y, pc.x),
                   wc = cross(pb.x, pa.y, pb.y, pa.x);
        const auto least = hn::Min(wa, hn::Min(wb, wc)), most = hn::Max(wa, hn::Max(wb, wc));
        const auto across = hn::Max(max_abs(pa.x, pb.x, pc.x), max_abs(pa.y, pb.y, pc.y));
        const Errors e = errors(r, largest(qa, qb, qc), across);
        const auto sure = hn::Or(hn::Gt(least, e.determinant), hn::Lt(most, hn::Neg(e.determinant)));
        const auto det = hn::Add(hn::Add(wa, wb), wc);
        const auto depth = hn::Sub(hn::Max(pa.z, hn::Max(pb.z, pc.z)), hn::Min(pa.z, hn::Min(pb.z, pc.z)));
        const auto z = hn::Div(hn::Add(hn::Add(hn::Mul(wa, pa.z), hn::Mul(wb, pb.z)), hn::Mul(wc, pc.z)), det);
        const auto weight_error = hn::Div(hn::Mul(hn::Set(d, 5.0), e.determinant), hn::Abs(det));
        hn::Store(hn::Div(wb, det), d, u);
        hn::Store(hn::Div(wc, det), d, v);
        return answers(r, i, sure, e.coordinate, weight_error, depth, z, t);
    }

    HWY_INLINE std::uint32_t quads(std::size_t i, double* t, double* u, double* v) const {
        const Doubles d;
        const Sheared r = sheared(i);
        const Vertex to_corner = seen(r, 0, i), edge_u = edge(3, i), edge_v = edge(6, i);
        const Vertex q = shear(r, to_corner), eu = shear(r, edge_u), ev = shear(r, edge_v);
        auto det = cross(eu.x, ev.y, eu.y, ev.x), wu = cross(ev.x, q.y, ev.y, q.x), wv = cross(q.x, eu.y, q.y, eu.x);
        const auto turned = hn::Lt(det, hn::Zero(d));
        det = hn::IfThenElse(turned, hn::Neg(det), det);
        wu = hn::IfThenElse(turned, hn::Neg(wu), wu), wv = hn::IfThenElse(turned, hn::Neg(wv), wv);
        const auto least = hn::Min(wu, wv), most = hn::Max(wu, wv);
        const auto across = hn::Max(max_abs(q.x, eu.x, ev.x), max_abs(q.y, eu.y, ev.y));
        const Errors e = errors(r, largest(to_corner, edge_u, edge_v), across);
        const auto sure =
            hn::And(hn::Gt(least, e.determinant), hn::Gt(hn::Sub(det, most), hn::Mul(hn::Set(d, 3.0), e.determinant)));
        const auto u_hit = hn::Div(wu, det), v_hit = hn::Div(wv, det);
        const auto z = hn::Add(q.z, hn::Add(hn::Mul(u_hit, eu.z), hn::Mul(v_hit, ev.z)));
        const auto weight_error = hn::Div(hn::Mul(hn::Set(d, 4.0), e.determinant), det);
        hn::Store(u_hit, d, u);
        hn::Store(v_hit, d, v);
        return answers(r, i, sure, e.coordinate, weight_error, hn::Add(hn::Abs(eu.z), hn::Abs(ev.z)), z, t);
    }

    std::size_t size_ = 0;
    HWY_ALIGN double origin_[3][kMost], direction_[3][kMost], vertex_[9][kMost];
    HWY_ALIGN double origin_error_[kMost], direction_error_[kMost], t_min_[kMost], t_max_[kMost];
    std::uint32_t tag_[kMost];
};

// The same for filter_sphere.
template <std::size_t kLanes, std::size_t kMost>
class SphereWinners {
public:
    using Doubles = hn::CappedTag<double, kLanes>;
    using DV = hn::Vec<Doubles>;

    bool is_full() const { return size_ == kMost; }

    HWY_INLINE void add(const RayFrame& frame, const Search& search, const Point3& center, double radius,
                        std::uint32_t tag) {
        const std::size_t i = size_++;
        const Ray& ray = frame.ray;
        origin_[0][i] = ray.origin.x, origin_[1][i] = ray.origin.y, origin_[2][i] = ray.origin.z;
        direction_[0][i] = ray.direction.x, direction_[1][i] = ray.direction.y, direction_[2][i] = ray.direction.z;
        center_[0][i] = center.x, center_[1][i] = center.y, center_[2][i] = center.z;
        radius_[i] = radius;
        origin_error_[i] = frame.origin_error, direction_error_[i] = frame.direction_error;
        t_min_[i] = search.t_min, t_max_[i] = search.t_max;
        tag_[i] = tag;
    }

    template <class Answer>
    HWY_INLINE void settle(const Answer& answer) {
        const Doubles d;
        for (std::size_t i = 0; i < size_; i += hn::Lanes(d)) {
            HWY_ALIGN double t[kLanes];
            const std::uint32_t hits = roots(i, t);
            for (std::size_t k = 0; k < std::min(hn::Lanes(d), size_ - i); ++k) {
                const PlanarHit hit{t[k], 0, 0};
                answer(tag_[i + k], (hits >> k & 1) != 0 ? &hit : nullptr);
            }
        }
        size_ = 0;
    }

private:
    HWY_INLINE static DV dot(DV ax, DV ay, DV az, DV bx, DV by, DV bz) {
        return hn::Add(hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by)), hn::Mul(az, bz));
    }

    // What in_search says.
    struct Verdict {
        hn::Mask<Doubles> hit, miss;
    };
    HWY_INLINE static Verdict judge(DV t, DV error, DV t_min, DV t_max) {
        const Doubles d;
        const auto round = hn::PromoteTo(d, hn::DemoteTo(hn::Rebind<float, Doubles>(), t));
        const auto misses_round = hn::And(hn::Ne(t, round), hn::Le(hn::Abs(hn::Sub(t, round)), error));
        const auto accurate = hn::AndNot(misses_round, hn::Le(error, hn::Mul(hn::Set(d, kAccurate), hn::Abs(t))));
        const auto beyond = hn::Or(hn::Gt(hn::Sub(t, error), t_max), hn::Lt(hn::Add(t, error), t_min));
        const auto within = hn::And(hn::And(hn::Gt(t, t_min), hn::Le(t, t_max)), hn::Lt(t, hn::Set(d, kInfinity)));
        return {hn::AndNot(beyond, hn::And(accurate, within)), hn::Or(beyond, hn::AndNot(within, accurate))};
    }

    HWY_INLINE std::uint32_t roots(std::size_t i, double* t) const {
        const Doubles d;
        const auto load = [&](const double* row) HWY_ATTR { return hn::Load(d, row + i); };
        const auto set = [&](double x) HWY_ATTR { return hn::Set(d, x); };
        const auto dx = load(direction_[0]), dy = load(direction_[1]), dz = load(direction_[2]);
        const auto px = hn::Sub(load(origin_[0]), load(center_[0])), py = hn::Sub(load(origin_[1]), load(center_[1])),
                   pz = hn::Sub(load(origin_[2]), load(center_[2]));
        const auto radius = load(radius_);
        const auto squared = dot(dx, dy, dz, dx, dy, dz);
        const auto inverse_length = hn::Div(set(1), max_abs(dx, dy, dz));
        const auto slack = set(1 + 0x1p-30);
        const auto relative = hn::Mul(
            hn::Add(set(10 * kRoundoff), hn::Mul(hn::Mul(set(8), load(direction_error_)), inverse_length)), slack);
        const auto absolute = hn::Mul(hn::Mul(set(2), load(origin_error_)), slack);
        const auto reach = hn::Add(hn::Add(hn::Abs(px), hn::Abs(py)), hn::Abs(pz));
        const auto in_range = hn::And(
            hn::And(hn::Gt(squared, set(0x1p-460)), hn::Lt(squared, set(0x1p460))),
            hn::And(hn::Lt(reach, set(0x1p230)), hn::And(hn::Lt(radius, set(0x1p230)), hn::Gt(radius, set(0x1p-230)))));

        const auto foot_t = hn::Div(hn::Neg(dot(px, py, pz, dx, dy, dz)), squared);
        const auto fx = hn::Add(px, hn::Mul(foot_t, dx)), fy = hn::Add(py, hn::Mul(foot_t, dy)),
                   fz = hn::Add(pz, hn::Mul(foot_t, dz));
        const auto r2 = hn::Mul(radius, radius), foot2 = dot(fx, fy, fz, fx, fy, fz);
        const auto discriminant = hn::Sub(r2, foot2);
        const auto foot_error = hn::Add(hn::Mul(relative, reach), absolute);
        const auto error = hn::Add(hn::Mul(foot_error, hn::Add(hn::Mul(set(4), radius), foot_error)),
                                   hn::Mul(set(32 * kRoundoff), hn::Add(r2, foot2)));

        const auto half_chord = hn::Sqrt(hn::Div(discriminant, squared));
        const auto outer = hn::Add(foot_t, hn::CopySign(half_chord, foot_t)), size = hn::Abs(outer);
        const auto outer_error = hn::Add(hn::Add(hn::Mul(foot_error, inverse_length),
                                                 hn::Mul(half_chord, hn::Add(hn::Div(error, discriminant), relative))),
                                         hn::Mul(set(4 * kRoundoff), size));
        const auto power = hn::Sub(dot(px, py, pz, px, py, pz), r2);
        const auto power_error = hn::Add(hn::Mul(set(8 * kRoundoff), hn::Add(hn::Mul(reach, reach), r2)),
                                         hn::Mul(absolute, hn::Add(hn::Mul(set(2), reach), absolute)));
        const auto inner = hn::Div(power, hn::Mul(squared, outer));
        const auto inner_error = hn::Add(
            hn::Mul(hn::Div(power_error, hn::Mul(squared, size)), set(2)),
            hn::Mul(hn::Abs(inner), hn::Add(hn::Mul(set(2), hn::Div(outer_error, size)), hn::Mul(set(2), relative))));
        const auto sure =
            hn::And(in_range, hn::And(hn::Gt(discriminant, error), hn::Le(outer_error, hn::Mul(set(0.25), size))));
        const auto is_outer_first = hn::Lt(outer, inner);
        const auto near = hn::IfThenElse(is_outer_first, outer, inner),
                   far = hn::IfThenElse(is_outer_first, inner, outer);
        const auto t_min = load(t_min_), t_max = load(t_max_);
        const Verdict first = judge(near, hn::IfThenElse(is_outer_first, outer_error, inner_error), t_min, t_max);
        const Verdict last = judge(far, hn::IfThenElse(is_outer_first, inner_error, outer_error), t_min, t_max);
        hn::Store(hn::IfThenElse(first.hit, near, far), d, t);
        return bits(d, hn::And(sure, hn::Or(first.hit, hn::And(first.miss, last.hit))));
    }

    std::size_t size_ = 0;
    HWY_ALIGN double origin_[3][kMost], direction_[3][kMost], center_[3][kMost], radius_[kMost];
    HWY_ALIGN double origin_error_[kMost], direction_error_[kMost], t_min_[kMost], t_max_[kMost];
    std::uint32_t tag_[kMost];
};

using ManyWinners = PlanarWinners<8, 64>;
using ManySphereWinners = SphereWinners<8, 64>;

HWY_INLINE bool settle_one(const RayFrame& frame, const Search& search, const Point3& center, double radius,
                           PlanarHit& hit) {
    SphereWinners<1, 1> winner;
    winner.add(frame, search, center, radius, 0);
    bool answered = false;
    winner.settle([&](std::uint32_t, const PlanarHit* found) {
        answered = found != nullptr;
        if (answered) hit = *found;
    });
    return answered;
}

// The same for one ray; false: not answered here.
template <bool kQuad, class A, class B>
HWY_INLINE bool settle_one(const RayFrame& frame, const Search& search, const A& a, const B& b, const B& c,
                           PlanarHit& hit) {
    PlanarWinners<1, 1> winner;
    winner.add(frame, search, a, b, c, 0);
    bool answered = false;
    winner.template settle<kQuad>([&](std::uint32_t, const PlanarHit* found) {
        answered = found != nullptr;
        if (answered) hit = *found;
    });
    return answered;
}

}  // namespace limn::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
