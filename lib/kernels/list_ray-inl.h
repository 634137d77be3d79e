// One ray against all primitives of a small scene, a primitive in each lane. Per-target include guard, as Highway has
// it.
#if defined(LIMN_KERNELS_LIST_RAY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_KERNELS_LIST_RAY_INL_H
#undef LIMN_KERNELS_LIST_RAY_INL_H
#else
#define LIMN_KERNELS_LIST_RAY_INL_H
#endif

#include "kernels/list_packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::kernels::HWY_NAMESPACE {

// Sure hits of the primitives from `number` on: noted in `near` and `waiting`, and `bound` lowered to the nearest.
HWY_INLINE void keep_listed(RM certain, RV t_near, RV t_far, std::size_t number, float* near, std::uint64_t& waiting,
                            float& bound) {
    const RayLanes d;
    hn::StoreU(t_near, d, near + number);
    waiting |= std::uint64_t{bits(d, certain)} << number;
    const auto beyond = hn::MulAdd(hn::Abs(t_far), hn::Set(d, 0x1p-22f), t_far);
    const float least = hn::GetLane(hn::MinOfLanes(d, hn::IfThenElse(certain, beyond, hn::Set(d, bound))));
    if (least < bound) bound = least;
}

// As ListPacket, but for the way the lanes go. One function, whose values stay in registers: a class with these members
// takes a sixth longer.
template <class Query>
HWY_INLINE void search_list(const flat::Scene& scene, const Ray& ray, const RayFrame& frame, Query& query) {
    const RayLanes d;
    const PrimitiveList& list = scene.list;
    const auto extent = static_cast<float>(flat::group_at(scene, GroupId::root).extent);
    const auto ox = static_cast<float>(ray.origin.x), oy = static_cast<float>(ray.origin.y),
               oz = static_cast<float>(ray.origin.z);
    const auto dx = static_cast<float>(ray.direction.x), dy = static_cast<float>(ray.direction.y),
               dz = static_cast<float>(ray.direction.z);
    const auto largest = [](float a, float b, float c) {
        const float x = std::abs(a), y = std::abs(b), z = std::abs(c), xy = x > y ? x : y;
        return xy > z ? xy : z;
    };
    const float size = largest(dx, dy, dz), reach = largest(ox, oy, oz) + extent;
    const bool ordinary = size > 0x1p-10f && size < 0x1p10f && reach < 8 * extent;
    if (HWY_UNLIKELY(!ordinary)) {
        ask_all_listed(scene, frame, query);
        return;
    }
    const LaneRay<RayLanes> lanes{hn::Set(d, ox),       hn::Set(d, oy),
                                  hn::Set(d, oz),       hn::Set(d, dx),
                                  hn::Set(d, dy),       hn::Set(d, dz),
                                  hn::Set(d, reach),    hn::Set(d, size),
                                  hn::Set(d, 1 / size), hn::Set(d, 1 / (dx * dx + dy * dy + dz * dz))};
    // No t that is met comes near these limits.
    const auto limited = [](double t) { return static_cast<float>(larger(-0x1p120, limn::smaller(0x1p120, t))); };
    const float low = limited(ray.t_min), high = limited(query.limit());
    const auto possible_after = hn::Set(d, below(low)), certain_after = hn::Set(d, above(low)),
               certain_before = hn::Set(d, below(high));
    float bound = above(high);
    HWY_ALIGN float near[PrimitiveList::kMost + 2 * kPacket];
    std::uint64_t waiting = 0;
    for (std::size_t i = 0; i < list.planars(); i += hn::Lanes(d)) {
        const float* rows = list.planar.data() + i;
        const std::size_t stride = list.planar_stride;
        const auto is_triangle = hn::Not(hn::FirstN(d, list.quads > i ? list.quads - i : 0));
        const auto there = hn::FirstN(d, list.planars() - i);
        const auto met = meet_listed(
            d, [&](std::size_t r) HWY_ATTR { return hn::LoadU(d, rows + r * stride); }, is_triangle, lanes);
        const auto outside =
            hn::And(met.known, hn::Or(hn::Gt(met.near, hn::Set(d, bound)), hn::Lt(met.far, possible_after)));
        const auto open = hn::AndNot(hn::Or(met.missed, outside), there);
        if (hn::AllFalse(d, open)) continue;
        const auto certain = hn::And(hn::And(open, met.certain),
                                     hn::And(hn::Gt(met.near, certain_after), hn::Lt(met.far, certain_before)));
        const std::uint32_t certain_bits = bits(d, certain);
        if constexpr (Query::kFirstHit) {
            if (certain_bits != 0) {
                query.report({}, 0, false);
                return;
            }
        } else if (certain_bits != 0) {
            keep_listed(certain, met.near, met.far, i, near, waiting, bound);
        }
        std::uint32_t unsure = bits(d, open) & ~certain_bits;
        if (unsure != 0) {
            hn::Store(met.near, d, near + i);
            const std::uint32_t known = bits(d, met.known);
            const std::uint32_t leaving =
                ray.t_min >= 0 ? bits(d, hn::And(met.known, hn::Lt(met.near, hn::Zero(d)))) : 0u;
            const std::uint32_t against = bits(d, hn::Lt(met.along, hn::Zero(d)));
            for (; unsure != 0; unsure &= unsure - 1) {
                const auto k = static_cast<std::uint32_t>(std::countr_zero(unsure));
                if ((known >> k & 1) != 0 && near[i + k] > bound) continue;
                const PrimitiveList::Entry& e = list.entries[i + k];
                if ((leaving >> k & 1) != 0 && is_behind(e, broadcast<double>(ray.origin), (against >> k & 1) != 0))
                    continue;
                ask_listed(scene, e, frame, query);
                if (query.ended()) return;
                const float limit = above(limited(query.limit()));
                if (limit < bound) bound = limit;
            }
        }
    }
    const auto ray_of_spheres = sphere_ray(lanes);
    for (std::size_t i = 0; i < list.spheres; i += hn::Lanes(d)) {
        const float* rows = list.round.data() + i;
        const std::size_t stride = list.sphere_stride, number = list.planars() + i;
        const auto row = [&](std::size_t r) HWY_ATTR { return load<RayFloats>(rows + r * stride); };
        const auto roots = float_roots(three<RayFloats>(row, 0), row(PrimitiveList::kRadius), ray_of_spheres);
        const auto root = first_root<RayFloats>(roots, certain_after, {possible_after, bound});
        const auto open = root.open & first_lanes<RayFloats>(list.spheres - i);
        if (!any(open)) continue;
        const auto certain = open & root.certain & (root.far < RayFloats(certain_before));
        const std::uint32_t certain_bits = bits(certain);
        if constexpr (Query::kFirstHit) {
            if (certain_bits != 0) {
                query.report({}, 0, false);
                return;
            }
        } else if (certain_bits != 0) {
            keep_listed(certain.m, root.near.v, root.far.v, number, near, waiting, bound);
        }
        for (std::uint32_t unsure = bits(open) & ~certain_bits; unsure != 0; unsure &= unsure - 1) {
            const PrimitiveList::Entry& e = list.entries[number + static_cast<std::uint32_t>(std::countr_zero(unsure))];
            if (ray.t_min >= 0 && side_of(e.corner, e.radius, ray) == Side::missed) continue;
            ask_listed(scene, e, frame, query);
            if (query.ended()) return;
            const float limit = above(limited(query.limit()));
            if (limit < bound) bound = limit;
        }
    }
    for (; waiting != 0; waiting &= waiting - 1) {
        const auto k = static_cast<std::size_t>(std::countr_zero(waiting));
        if (near[k] > bound) continue;
        const PrimitiveList::Entry& e = list.entries[k];
        ask_listed(scene, e, frame, query);
    }
}

}  // namespace limn::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
