// Rays against single primitives of a list, exactly. Per-target include guard, as Highway has it.
#if defined(LIMN_KERNELS_LIST_EXACT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_KERNELS_LIST_EXACT_INL_H
#undef LIMN_KERNELS_LIST_EXACT_INL_H
#else
#define LIMN_KERNELS_LIST_EXACT_INL_H
#endif

#include "kernels/shapes-inl.h"
#include "kernels/traverse.h"

HWY_BEFORE_NAMESPACE();
namespace limn::kernels::HWY_NAMESPACE {

inline constexpr unsigned kListedKinds = flat::bit(PrimitiveKind::quad) | flat::bit(PrimitiveKind::triangle) |
                                         flat::bit(PrimitiveKind::mesh) | flat::bit(PrimitiveKind::sphere);

template <class Visit>
HWY_INLINE bool with_listed(const flat::Scene& scene, const flat::PrimitiveList::Entry& e, const Visit& visit) {
    return with_shape<kListedKinds>(scene, e.kind, e.row, e.element, 0, visit);
}

// Of flat ones: whether the plane lies behind an origin. `against`: where the direction goes against the normal.
template <class N>
HWY_INLINE Mask<N> is_behind(const flat::PrimitiveList::Entry& e, const Vector<N>& origin, Mask<N> against) {
    const double edge = larger(max_abs(e.edge_u), max_abs(e.edge_v));
    const double edge_error = e.error + (e.kind == PrimitiveKind::quad ? 0 : kRoundoff * edge);
    return is_behind(broadcast<N>(e.edge_u), broadcast<N>(e.edge_v), broadcast<N>(e.corner) - origin, N(edge_error),
                     N(e.error), against);
}

// Asks one primitive and reports a hit to the query. `frame`: of the world.
template <class Query>
HWY_NOINLINE void ask_listed(const flat::Scene& scene, const flat::PrimitiveList::Entry& e, const RayFrame& frame,
                             Query& query) {
    const auto ask = [&](const RayFrame& seen) HWY_ATTR {
        return with_listed(scene, e, [&](const auto& shape) HWY_ATTR {
            PlanarHit hit;
            return intersect(shape, seen, {seen.ray.t_min, query.limit()}, hit) && query.report(hit, e.number, false);
        });
    };
    if (HWY_LIKELY(!e.is_instanced))
        ask(frame);
    else
        inside(scene.instances[e.instance], frame,
               [&](const RayFrame& inner) HWY_ATTR { return is_usable(inner.ray) && ask(inner); });
}

// Each in turn, until the query has its answer: for rays that float cannot hold. Whether it has.
template <class Query>
bool ask_all_listed(const flat::Scene& scene, const RayFrame& frame, Query& query) {
    for (const flat::PrimitiveList::Entry& e : scene.list.entries) {
        ask_listed(scene, e, frame, query);
        if (query.ended()) return true;
    }
    return false;
}

}  // namespace limn::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
