// Tests of rays against listed primitives: in float, for up to sixteen rays or primitives at once, and exactly. The
// include guard is per target, as Highway requires.
#if defined(LIMN_TRACE_LIST_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_TRACE_LIST_INL_H
#undef LIMN_TRACE_LIST_INL_H
#else
#define LIMN_TRACE_LIST_INL_H
#endif

#include <limits>

#include "flat/list.h"
#include "geometry/sphere_float-inl.h"
#include "trace/report-inl.h"
#include "trace/traverse.h"

HWY_BEFORE_NAMESPACE();
namespace limn::trace::HWY_NAMESPACE {

using flat::PrimitiveList;

using RayFloats = Wide<hn::CappedTag<float, 16>>;
inline constexpr std::size_t kPacket = kLanes<RayFloats>;

// A ray, or one in each lane, in float.
//
// Bounds on errors. Let u = 2^-24, D the largest coordinate of the direction d, and R = |origin| + extent, which bounds
// all coordinates. The plane n.x = k has |n| <= 1 along each axis. The ray meets it at t = a / b with a = k - n.o and b
// = n.d.
//   - a is off by 16 u R, and b by 16 u D.
//   - So if |b| > 2^-15 D, t is off by (16 u R + 16 u D |t|) / (|b| - 16 u D), plus 2 u |t| for its rounding. With T =
//   R
//     + |t| D and s = D / |b|, D times that is at most u T (17 s + 2).
//   - The point o + t d is off by that, plus 3 u T for rounding.
//   - A weight v.x - k' is off by the sum of the magnitudes of v, times the error of the point plus 8 u T. The second
//     factor is G = u T (17 s + 11).
struct ListRay {
    Vector<RayFloats> origin, direction;
    RayFloats reach, size, inverse_size;  // R, D, 1 / D
    Mask<RayFloats> is_ordinary;          // true if these bounds hold: see the constructor

    HWY_INLINE ListRay(const Vector<RayFloats>& o, const Vector<RayFloats>& d, float extent)
        : origin(o), direction(d), reach(max_abs(o) + extent), size(max_abs(d)), inverse_size(1.0f / size) {
        is_ordinary = (size > 0x1p-10f) & (size < 0x1p10f) & (reach < 8 * extent);
    }
};

// The interval of a search in float. Hits before possible_after are outside it, and hits between the next two are
// surely inside, whatever the rounding. Hits after `bound` are outside, or not the nearest.
struct ListLimits {
    RayFloats possible_after, certain_after, certain_before, bound;

    HWY_INLINE ListLimits(RayFloats t_min, RayFloats t_max)
        : possible_after(below(t_min)),
          certain_after(above(t_min)),
          certain_before(below(t_max)),
          bound(above(t_max)) {}
};
// Larger than any t of a hit.
inline constexpr float kMostListed = 0x1p120f;

// The result of a test. If nothing is known of t, its bounds are infinite.
struct ListedHits : FloatHits<RayFloats> {
    Mask<RayFloats> inside;  // the line of the ray surely passes through the shape, at some t
    RayFloats along;         // n.d

    HWY_INLINE Mask<RayFloats> may_be_behind() const {
        return (near < 0.0f) & (near > -std::numeric_limits<float>::infinity());
    }
};

// Tests a ray against a planar primitive. row(r) returns row r of PrimitiveList, of one primitive in all lanes or of
// one in each.
template <class Row>
HWY_INLINE ListedHits test_listed_plane(const Row& row, Mask<RayFloats> is_triangle, const ListRay& ray,
                                        const ListLimits& limits) {
    using List = PrimitiveList;
    constexpr float kUlp = 0x1p-24f, kEndless = std::numeric_limits<float>::infinity();
    const Vector<RayFloats>&o = ray.origin, &d = ray.direction;
    // Compute t, and the weights at the point that is hit.
    const auto weight = [&](const Vector<RayFloats>& p, std::size_t first, std::size_t offset) HWY_ATTR {
        return mul_add(row(first), p.x, mul_add(row(first + 1), p.y, mul_sub(row(first + 2), p.z, row(offset))));
    };
    ListedHits hits;
    hits.along = mul_add(row(List::kNormal), d.x, mul_add(row(List::kNormal + 1), d.y, row(List::kNormal + 2) * d.z));
    const RayFloats inverse = 1.0f / hits.along, t = -weight(o, List::kNormal, List::kOffset) * inverse;
    const Vector<RayFloats> p{mul_add(t, d.x, o.x), mul_add(t, d.y, o.y), mul_add(t, d.z, o.z)};
    const RayFloats u = weight(p, List::kU, List::kUOffset), v = weight(p, List::kV, List::kVOffset);
    const RayFloats error =
        mul_add(abs(t), ray.size, ray.reach) * mul_add(abs(inverse) * ray.size, 17 * kUlp, 11 * kUlp);
    const RayFloats weight_error = mul_add(row(List::kSpread), error, 8 * kUlp), t_error = error * ray.inverse_size;
    const RayFloats outside = max(-min(u, v), select(is_triangle, u + v, max(u, v)) - 1.0f);
    const auto known = abs(hits.along) > 0x1p-15f * ray.size;
    hits.near = select(known, t - t_error, RayFloats(-kEndless));
    hits.far = select(known, t + t_error, RayFloats(kEndless));
    hits.inside = known & (outside < -weight_error);
    hits.certain = hits.inside & (hits.near > limits.certain_after) & (hits.far < limits.certain_before);
    hits.possible =
        !((known & (outside > weight_error)) | (hits.near > limits.bound) | (hits.far < limits.possible_after));
    return hits;
}

// Returns the ray for float_roots(). The vector from the origin to a centre is off by 2 u R for the rounding of both,
// with R as in ListRay, and by u of itself.
HWY_INLINE SphereFloatRay<RayFloats> sphere_ray(const ListRay& ray) {
    constexpr float kUlp = 0x1p-24f;
    const Vector<RayFloats>& d = ray.direction;
    return {.high = ray.origin,
            .inverse_squared = 1.0f / mul_add(d.x, d.x, mul_add(d.y, d.y, d.z * d.z)),
            .low = {0.0f, 0.0f, 0.0f},
            .inverse_length = ray.inverse_size * (1 + 0x1p-20f),
            .direction = d,
            .relative = 48 * kUlp,
            .absolute = 4.01f * kUlp * ray.reach};
}
template <class Row>
HWY_INLINE FloatRoots<RayFloats> listed_roots(const Row& row, const SphereFloatRay<RayFloats>& ray) {
    return float_roots(three<RayFloats>(row, PrimitiveList::kCenter), row(PrimitiveList::kRadius), ray);
}
HWY_INLINE FloatHits<RayFloats> first_listed(const FloatRoots<RayFloats>& roots, const ListLimits& limits) {
    FloatHits<RayFloats> hits =
        first_root<RayFloats>(roots, limits.certain_after, {limits.possible_after, limits.bound});
    hits.certain = hits.certain & (hits.far < limits.certain_before);
    return hits;
}

inline constexpr unsigned kListedKinds = flat::bit(PrimitiveKind::quad) | flat::bit(PrimitiveKind::triangle) |
                                         flat::bit(PrimitiveKind::mesh) | flat::bit(PrimitiveKind::sphere);

template <class Visit>
HWY_INLINE bool with_listed(const flat::Scene& scene, const PrimitiveList::Entry& e, const Visit& visit) {
    return with_shape<kListedKinds>(scene, e.kind, e.row, e.element, 0, visit);
}

// Returns true if the plane of a planar primitive is surely behind the origin. `against` is true if the direction goes
// against the normal.
template <class N>
HWY_INLINE Mask<N> is_behind(const PrimitiveList::Entry& e, const Vector<N>& origin, Mask<N> against) {
    const Vector<N> u = broadcast<N>(e.edge_u), v = broadcast<N>(e.edge_v);
    const double rounding = e.kind == PrimitiveKind::quad ? 0 : kRoundoff;
    const N edge_error = e.error + rounding * max(max_abs(u), max_abs(v));
    return is_behind(u, v, broadcast<N>(e.corner) - origin, edge_error, N(e.error), against);
}

// Calls visit() with the predicate of a primitive and the frame of the ray in the space of the primitive. `frame` is
// that in world space.
template <class Visit>
HWY_INLINE void as_seen(const flat::Scene& scene, const PrimitiveList::Entry& e, const RayFrame& frame,
                        const Visit& visit) {
    const auto visit_shape = [&](const RayFrame& seen) HWY_ATTR {
        return with_listed(scene, e, [&](const auto& shape) HWY_ATTR { return visit(shape, seen); });
    };
    if (HWY_LIKELY(!e.is_instanced))
        visit_shape(frame);
    else
        inside(scene.instances[e.instance], frame,
               [&](const RayFrame& inner) HWY_ATTR { return is_usable(inner.ray) && visit_shape(inner); });
}

// Intersects a primitive exactly, and reports a hit to the query. `frame` is that in world space.
template <class Query>
HWY_NOINLINE void intersect_listed(const flat::Scene& scene, const PrimitiveList::Entry& e, const RayFrame& frame,
                                   Query& query) {
    as_seen(scene, e, frame, [&](const auto& shape, const RayFrame& seen) HWY_ATTR {
        return report_hits(shape, seen, e.number, query);
    });
}

// Intersects all primitives exactly, until the query has ended: for rays that are not ordinary. Returns true if it has
// ended.
template <class Query>
bool intersect_all_listed(const flat::Scene& scene, const RayFrame& frame, Query& query) {
    for (const PrimitiveList::Entry& e : scene.list.entries) {
        intersect_listed(scene, e, frame, query);
        if (query.ended()) return true;
    }
    return false;
}

}  // namespace limn::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
