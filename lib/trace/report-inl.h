// Reports hits to queries: exact intersections of shapes, and hits that the float tests are sure of. The include guard
// is per target, as Highway requires.
#if defined(LIMN_TRACE_REPORT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_TRACE_REPORT_INL_H
#undef LIMN_TRACE_REPORT_INL_H
#else
#define LIMN_TRACE_REPORT_INL_H
#endif

#include "geometry/coordinate.h"
#include "geometry/passage-inl.h"
#include "trace/shapes-inl.h"
#include "trace/walk_ray-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::trace::HWY_NAMESPACE {

// Returns the interval in which a query searches.
template <class Query>
HWY_INLINE Search search_of(const RayFrame& frame, const Query& query) {
    return {frame.ray.t_min, query.limit()};
}

// Reports the passages of the moved ray (geometry/passage.h) through a shape. Returns true if the query ended the
// search.
template <class Shape, class Query>
HWY_INLINE bool report_passages(const Shape& shape, const RayFrame& frame, std::uint64_t number, Query& query) {
    const auto undecided = [&] {
        if (!query.wants_touched) return;
        const bool is_on = with_numbers(shape, [&](const auto&... of) { return is_origin_on(of..., frame); });
        if (is_on) query.touch(number);
    };
    return for_each_passage(shape, frame, search_of(frame, query), undecided,
                            [&](const Passage& p) { return query.report(p, number, p.inward); });
}

// Reports the first hit of a shape, or all hits if the query wants them. Returns true if the query ended the search.
template <class Shape, class Query>
HWY_INLINE bool report_hits(const Shape& shape, const RayFrame& frame, std::uint64_t number, Query& query) {
    if constexpr (Query::kMoved) {
        return report_passages(shape, frame, number, query);
    } else {
        PlanarHit hit;
        if (!intersect(shape, frame, search_of(frame, query), hit)) return false;
        return query.report(hit, number, Query::kEveryHit && is_inward(shape, frame));
    }
}

template <class Query>
HWY_INLINE bool report_hits(const SpherePredicate<double>& sphere, const RayFrame& frame, std::uint64_t number,
                            Query& query) {
    if constexpr (Query::kMoved) {
        return report_passages(sphere, frame, number, query);
    } else if constexpr (Query::kEveryHit) {
        const SphereHits hits = sphere.hits(frame, search_of(frame, query));
        return (hits.near_found && query.report({hits.near, 0, 0}, number, sphere.radius > 0)) ||
               (hits.far_found && query.report({hits.far, 0, 0}, number, sphere.radius < 0));
    } else {
        PlanarHit hit;
        return intersect(sphere, frame, search_of(frame, query), hit) && query.report(hit, number, false);
    }
}

template <class Kind, class Query>
HWY_INLINE bool report_hits(std::reference_wrapper<const Kind> row, const RayFrame& frame, std::uint64_t number,
                            Query& query) {
    PlanarHit hit;
    for (Search rest = search_of(frame, query); row.get().intersect(frame, rest, hit); rest.t_min = hit.t) {
        bool inward = false;
        if constexpr (Query::kEveryHit) {
            Surface surface;
            row.get().surface(frame.ray, hit, false, surface);
            inward = dot(Vec3(surface.normal), frame.ray.direction) < 0;
        }
        const bool end = query.report(hit, number, inward);
        if (end || !Query::kEveryHit) return end;
    }
    return false;
}

// A hit that the float test is sure of. It has not been intersected exactly yet.
struct SureHit {
    flat::Child leaf;
    std::uint32_t lane;
    float near, far;  // bounds on its t
};

#if HWY_MAX_BYTES >= 32

// Returns true if `t` is surely accurate (kAccurate) and surely no near miss of a float (judge()). \pre `t` is off by
// at most 2^-27 (far - near)
HWY_INLINE bool is_settled(double t, const SureHit& hit) {
    const double width = static_cast<double>(hit.far - hit.near), to_float = std::abs(t - rounded_to_float(t));
    return width <= static_cast<double>(hit.near) * 0x1p-5 && (to_float == 0 || to_float > width * 0x1p-27);
}

// Sets t, u and v of a triangle of a mesh that a ray in world space surely hits, to the bits that
// TrianglePredicate::filter reports. Returns false if it isn't certain that the filter would report them. The
// operations are those of the filter in the same order, with three vertices in the lanes of a vector. The filter's
// error bounds aren't computed, because those of the float test are far larger.
//
// Let E and e be the bounds on a sheared coordinate and an edge value in float, E' and e' those in double, and M the
// largest magnitude of the vertices' coordinates relative to the origin. Both tests permute the axes alike; the
// function returns false if they don't.
//   - E >= 16 2^-24 M and E' = 8 2^-53 M, so E' <= 2^-30 E. As the sheared coordinates are the same but for E, e' <=
//     2^-30 e.
//   - In float an edge value is off by at most 13/16 e: a sheared coordinate is off by 13 2^-24 M of the 16 2^-24 M in
//     E, and by 9 2^-48 R of the 2^-44 R in E (PlanarFloatRay). All three edge values exceed e. So the exact ones
//     exceed 3/16 e, and their sum S exceeds 9/16 e. The filter finds that the ray passes through the inside, too.
//   - The weights in double are off by at most 5 e' / |S| <= 2^-26.8, less than kAccurateWeight.
//   - The float test's sum is at most 3 e from S, so |S| is at least 1/6 of it. The depth in double exceeds that in
//     float by at most E. Then the bound on z in double, 10 e' / |S| depth + 2 E', is at most 2^-27.4 times that in
//     float, 10 e / |sum| depth + 4 E.
//   - far - near is twice the bound on t in float, less its rounding, 1/30 of itself. Therefore t in double is off by
//     at most 2^-28 (far - near).
HWY_INLINE bool locate_sure_hit(const flat::BlockView& block, const SureHit& sure, const WalkRay& walk_ray,
                                const Ray& ray, PlanarHit& hit) {
    const Doubles4 wide;
    const Floats4 d;
    // Permute the axes as Axes<double> does.
    const double x = std::abs(ray.direction.x), y = std::abs(ray.direction.y), z = std::abs(ray.direction.z);
    const std::uint32_t longest = !((x > y ? x : y) > z) ? 2 : x > y ? 0 : 1;
    if (HWY_UNLIKELY(longest != walk_ray.rows[2])) return false;
    const auto axis = [&](std::size_t a) { return std::size_t{walk_ray.rows[a]}; };
    // Take the vertices relative to the origin, and shear them. The lanes are those of a, b, c and c again.
    const auto corner = [&](std::size_t a) HWY_ATTR {
        const auto vertex = [&](std::size_t k) HWY_ATTR { return hn::Set(d, block.row(3 * k + axis(a))[sure.lane]); };
        const auto all = hn::ConcatUpperLower(d, vertex(2), hn::OddEven(vertex(1), vertex(0)));
        return hn::Sub(hn::PromoteTo(wide, all), hn::Set(wide, number_of<double>(ray.origin, axis(a))));
    };
    const double along = number_of<double>(ray.direction, axis(2));
    const auto qz = corner(2);
    const auto sheared = [&](std::size_t a) HWY_ATTR {
        return hn::Sub(corner(a), hn::Mul(hn::Set(wide, number_of<double>(ray.direction, axis(a)) / along), qz));
    };
    const auto px = sheared(0), py = sheared(1);
    // Compute the edge values.
    alignas(32) static constexpr std::int64_t kBefore[4] = {2, 0, 1, 3}, kAfter[4] = {1, 2, 0, 3};
    const auto before = hn::SetTableIndices(wide, kBefore), after = hn::SetTableIndices(wide, kAfter);
    const auto w = hn::Sub(hn::Mul(hn::TableLookupLanes(px, before), hn::TableLookupLanes(py, after)),
                           hn::Mul(hn::TableLookupLanes(py, before), hn::TableLookupLanes(px, after)));
    // Compute t and the weights.
    alignas(32) double ws[4], wz[4];
    hn::Store(w, wide, ws);
    hn::Store(hn::Mul(w, qz), wide, wz);
    const double det = ws[0] + ws[1] + ws[2];
    const double t = (wz[0] + wz[1] + wz[2]) / det / along;
    hit = {t, ws[1] / det, ws[2] / det};
    return is_settled(t, sure);
}

// The same for a sphere and SpherePredicate::filter.
//
// Let E and D be the bounds on the foot point and the discriminant in float, E' and D' those in double, and L, r, F, d
// as in SpherePredicate::roots(). Let h be the half chord, t_F the t of the foot point, u = 2^-53 and v = 2^-24. The
// bound on a root in float is e = 2 E / |d| + 2 h (D / (r^2 - F.F) + 48 v) + 16 v (|t_F| + h).
//   - E' <= 2^-31 E and D' <= 2^-30 D. The discriminant in float is off by at most half of D, and it exceeds D. So that
//     in double is at least half of it. Therefore the root of larger magnitude, `outer`, is off by at most 2^-29 e in
//     double, less than a quarter of itself.
//   - The other is off by 16 u (L^2 + r^2) / (d.d |outer|), twice the error of `outer`, and 20 u of itself. Here L^2 <=
//     3 (t_F^2 d.d + r^2), and |outer| is at least |t_F| and h. So the first term is at most 48 u |t_F| + 64 u r^2 /
//     (d.d h). In e there are 16 v |t_F|, and 128 v r^2 / (d.d h) because D >= 64 v r^2. Therefore it is off by at most
//     2^-26 e.
//   - far - near is 2 e, less its rounding, 1/8 of itself. So both roots are off by at most 2^-27 (far - near).
//   - The float test is sure on which side of t_min the first root is, with e to spare. So the filter is too.
HWY_INLINE bool locate_sure_hit(const SpherePredicate<double>& sphere, const SureHit& sure, const Ray& ray,
                                PlanarHit& hit) {
    const auto d = broadcast<double>(ray.direction), p = broadcast<double>(ray.origin) - sphere.center;
    const double r = abs(sphere.radius), squared = dot(d, d), foot_t = -dot(p, d) / squared;
    const Vector<double> foot = p + foot_t * d;
    const double r2 = r * r, half_chord = sqrt((r2 - dot(foot, foot)) / squared);
    const double outer = foot_t + copy_sign(half_chord, foot_t), inner = (dot(p, p) - r2) / (squared * outer);
    const double first = min(outer, inner), last = max(outer, inner);
    hit = {first > ray.t_min ? first : last, 0, 0};
    return is_settled(hit.t, sure);
}

#endif

}  // namespace limn::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
