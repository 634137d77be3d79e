// Rays of any directions against all primitives of a small scene, a lane each. Per-target include guard, as Highway has
// it.
#if defined(LIMN_KERNELS_LIST_PACKET_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_KERNELS_LIST_PACKET_INL_H
#undef LIMN_KERNELS_LIST_PACKET_INL_H
#else
#define LIMN_KERNELS_LIST_PACKET_INL_H
#endif

#include "kernels/box_ray.h"
#include "kernels/list-inl.h"
#include "kernels/list_exact-inl.h"
#include "kernels/queries.h"
#include "predicates/sphere_side.h"

HWY_BEFORE_NAMESPACE();
namespace limn::kernels::HWY_NAMESPACE {

using RayLanes = hn::CappedTag<float, 16>;
using RV = hn::Vec<RayLanes>;
using RM = hn::Mask<RayLanes>;
using RayFloats = Wide<RayLanes>;
inline constexpr std::size_t kPacket = hn::MaxLanes(RayLanes());

// Query: Closest or Any<false>, one for each ray. As in Traversal, sure hits wait, the nearest alone is to be asked
// exactly: it is left in `winners`, by entry.
template <class Query>
class ListPacket {
public:
    static constexpr std::uint32_t kNone = ~std::uint32_t{0};

    // All is kept by reference. \pre 0 < count <= kPacket; `winners` has room for kPacket
    ListPacket(const flat::Scene& scene, const Ray* rays, std::size_t count, Query* queries, std::uint32_t* winners)
        : scene_(scene), list_(scene.list), rays_(rays), queries_(queries), winners_(winners), count_(count) {
        const auto extent = static_cast<float>(flat::group_at(scene, GroupId::root).extent);
        for (std::size_t i = 0; i < kPacket; ++i) {
            const Ray& ray = rays[i < count ? i : 0];
            for (std::size_t a = 0; a < 3; ++a) {
                origin_[a][i] = ray.origin[a];
                direction_[a][i] = ray.direction[a];
            }
            t_min_[i] = ray.t_min, t_max_[i] = i < count ? queries[i].limit() : -kInfinity;
        }
        set_up(extent);
    }

    // Returns the lanes that may still meet what is not listed.
    std::uint32_t run() {
        const RayLanes d;
        LaneRay<RayLanes> ray{hn::Load(d, o_[0]),         hn::Load(d, o_[1]), hn::Load(d, o_[2]),  hn::Load(d, d_[0]),
                              hn::Load(d, d_[1]),         hn::Load(d, d_[2]), hn::Load(d, reach_), hn::Load(d, size_),
                              hn::Load(d, inverse_size_), hn::Zero(d)};
        if (list_.spheres != 0)
            ray.inverse_squared = hn::Div(
                hn::Set(d, 1.0f), hn::MulAdd(ray.dx, ray.dx, hn::MulAdd(ray.dy, ray.dy, hn::Mul(ray.dz, ray.dz))));
        hn::Store(hn::Set(hn::RebindToUnsigned<RayLanes>(), kNone), hn::RebindToUnsigned<RayLanes>(), winners_);
        const auto all = hn::FirstN(d, hn::Lanes(d)), none = hn::FirstN(d, 0);
        for (std::uint32_t i = 0; i < list_.quads; ++i) {
            planar(i, none, ray);
            if (Query::kFirstHit && active_ == 0) break;
        }
        for (std::uint32_t i = list_.quads; i < list_.planars(); ++i) {
            planar(i, all, ray);
            if (Query::kFirstHit && active_ == 0) break;
        }
        for (std::uint32_t i = 0; i < list_.spheres; ++i) {
            if (Query::kFirstHit && active_ == 0) break;
            sphere(i, ray);
        }
        for (std::size_t r = 0; r < count_; ++r)
            if ((odd_ >> r & 1) != 0 && ask_all_listed(scene_, RayFrame(rays_[r]), queries_[r])) odd_ &= ~(1u << r);
        if (list_.is_all) return 0;
        std::uint32_t rest = active_ & meets_rest(ray);
        const bool is_planar = (scene_.kinds & ~flat::kPlanarKinds) == 0;  // what stands in trees, and in no instance
        if (Query::kFirstHit && rest != 0 && is_planar) rest &= ~ends_before_rest(rest);
        return odd_ | rest;
    }

private:
    // As BoxRay has it, but for the order.
    HWY_INLINE std::uint32_t meets_rest(const LaneRay<RayLanes>& ray) const {
        const RayLanes d;
        auto enter = hn::Load(d, possible_after_), leave = hn::Load(d, bound_);
        const auto wider = hn::Mul(hn::Set(d, BoxRay::kWider), ray.reach);
        const auto cut = [&](RV o, RV direction, std::size_t a) HWY_ATTR {
            const auto inverse = hn::Div(
                hn::Set(d, 1.0f), hn::CopySign(hn::Max(hn::Abs(direction), hn::Set(d, BoxRay::kLeast)), direction));
            const auto shift = hn::Neg(hn::Mul(o, inverse)), widening = hn::Mul(wider, hn::Abs(inverse));
            const auto lower = hn::MulAdd(hn::Set(d, list_.rest_lower[a]), inverse, shift),
                       upper = hn::MulAdd(hn::Set(d, list_.rest_upper[a]), inverse, shift);
            enter = hn::Max(enter, hn::Sub(hn::Min(lower, upper), widening));
            leave = hn::Min(leave, hn::Add(hn::Max(lower, upper), widening));
        };
        cut(ray.ox, ray.dx, 0), cut(ray.oy, ray.dy, 1), cut(ray.oz, ray.dz, 2);
        return bits(d, hn::Le(enter, leave));
    }

    void set_up(float extent) {
        const RayLanes d;
        const auto ox = demoted(origin_[0]), oy = demoted(origin_[1]), oz = demoted(origin_[2]);
        const auto dx = demoted(direction_[0]), dy = demoted(direction_[1]), dz = demoted(direction_[2]);
        hn::Store(ox, d, o_[0]), hn::Store(oy, d, o_[1]), hn::Store(oz, d, o_[2]);
        hn::Store(dx, d, d_[0]), hn::Store(dy, d, d_[1]), hn::Store(dz, d, d_[2]);
        const auto start = max_abs(Vector<RayFloats>{ox, oy, oz}).v, size = max_abs(Vector<RayFloats>{dx, dy, dz}).v;
        const auto reach = hn::Add(start, hn::Set(d, extent));
        hn::Store(reach, d, reach_);
        hn::Store(size, d, size_);
        hn::Store(hn::Div(hn::Set(d, 1.0f), size), d, inverse_size_);
        // No t that is met comes near these limits.
        const auto most = hn::Set(d, 0x1p120f), least = hn::Neg(most);
        const auto low = hn::Max(least, hn::Min(most, demoted(t_min_))),
                   high = hn::Max(least, hn::Min(most, demoted(t_max_)));
        const auto slack = hn::Set(d, 0x1p-22f);
        const auto low_slack = hn::Mul(hn::Abs(low), slack), high_slack = hn::Mul(hn::Abs(high), slack);
        hn::Store(hn::Sub(low, low_slack), d, possible_after_);
        hn::Store(hn::Add(low, low_slack), d, certain_after_);
        hn::Store(hn::Sub(high, high_slack), d, certain_before_);
        hn::Store(hn::Add(high, high_slack), d, bound_);
        const auto ordinary = hn::And(hn::And(hn::Gt(size, hn::Set(d, 0x1p-10f)), hn::Lt(size, hn::Set(d, 0x1p10f))),
                                      hn::Lt(reach, hn::Set(d, 8 * extent)));
        const std::uint32_t there = (1u << count_) - 1;
        active_ = bits(d, ordinary) & there;
        odd_ = there & ~active_;
        leaving_ = bits(d, hn::Ge(low, hn::Zero(d)));
    }

    static RV demoted(const double* from) {
        const RayLanes d;
#if HWY_TARGET == HWY_SCALAR
        return hn::Set(d, static_cast<float>(from[0]));
#else
        const hn::Half<RayLanes> dh;
        const hn::Rebind<double, hn::Half<RayLanes> > dd;
        return hn::Combine(d, hn::DemoteTo(dh, hn::Load(dd, from + kPacket / 2)), hn::DemoteTo(dh, hn::Load(dd, from)));
#endif
    }

    HWY_INLINE void planar(std::uint32_t i, RM is_triangle, const LaneRay<RayLanes>& ray) {
        const RayLanes d;
        const float* rows = list_.planar.data() + i;
        const std::size_t stride = list_.planar_stride;
        const auto met = meet_listed(
            d, [&](std::size_t r) HWY_ATTR { return hn::Set(d, rows[r * stride]); }, is_triangle, ray);
        const auto bound = hn::Load(d, bound_);
        const auto outside =
            hn::And(met.known, hn::Or(hn::Gt(met.near, bound), hn::Lt(met.far, hn::Load(d, possible_after_))));
        std::uint32_t open = bits(d, hn::Not(hn::Or(met.missed, outside))) & active_;
        if (open == 0) return;
        const auto certainly = hn::And(met.certain, hn::And(hn::Gt(met.near, hn::Load(d, certain_after_)),
                                                            hn::Lt(met.far, hn::Load(d, certain_before_))));
        std::uint32_t certain = bits(d, certainly) & open;
        if (certain != open) {
            std::uint32_t unsure = open & ~certain;
            // A ray leaves the surface that it starts on, and a shadow ray ends just before the light.
            const std::uint32_t leaving =
                unsure & leaving_ & bits(d, hn::And(met.known, hn::Lt(met.near, hn::Zero(d))));
            if (leaving != 0) unsure &= ~behind(list_.entries[i], leaving, bits(d, hn::Lt(met.along, hn::Zero(d))));
            const std::uint32_t inside = unsure & bits(d, met.certain);
            if (inside != 0 && !list_.entries[i].is_instanced) unsure &= ~decide(i, inside);
            for (; unsure != 0; unsure &= unsure - 1) ask(static_cast<std::size_t>(std::countr_zero(unsure)), i);
            certain &= active_;
        }
        take(i, certain, met.near, met.far);
    }

    HWY_INLINE void sphere(std::uint32_t i, const LaneRay<RayLanes>& ray) {
        const float* rows = list_.round.data() + i;
        const std::size_t stride = list_.sphere_stride;
        const auto row = [&](std::size_t r) HWY_ATTR { return RayFloats(rows[r * stride]); };
        const auto met = float_roots(three<RayFloats>(row, 0), row(PrimitiveList::kRadius), sphere_ray(ray));
        const auto certain_before = load<RayFloats>(certain_before_), certain_after = load<RayFloats>(certain_after_);
        auto root =
            first_root<RayFloats>(met, certain_after, {load<RayFloats>(possible_after_), load<RayFloats>(bound_)});
        const std::uint32_t open = bits(root.open) & active_;
        if (open == 0) return;
        std::uint32_t certain = bits(root.certain & (root.far < certain_before)) & open;
        if (certain != open) {
            const std::uint32_t number = list_.planars() + i;
            const std::uint32_t ahead =
                bits(met.certain & (met.near_last > certain_after) & (met.far_last < certain_before));
            std::uint32_t inside = 0;
            for (std::uint32_t unsure = open & ~certain; unsure != 0; unsure &= unsure - 1) {
                const auto r = static_cast<std::size_t>(std::countr_zero(unsure));
                const PrimitiveList::Entry& e = list_.entries[number];
                const Side side = (leaving_ >> r & 1) != 0 ? side_of(e.corner, e.radius, rays_[r]) : Side::unknown;
                if (side == Side::inside && (ahead >> r & 1) != 0)
                    inside |= 1u << r;
                else if (side != Side::missed)
                    ask(r, number);
            }
            const auto within = mask_of<RayFloats>(inside);
            root.near = select(within, met.near_last, root.near);
            root.far = select(within, met.far_last, root.far);
            certain = (certain | inside) & active_;
        }
        take(list_.planars() + i, certain, root.near.v, root.far.v);
    }

    // Of rays to a point, which end just before t = 1, those whose point lies in front of the box of the rest along
    // some axis, as the origin does: shadow rays for lamps that lie in its sides. What is there is met at t >= 1, so a
    // filter that finds less than t_max < 1 has an error of at least the way to 1, and leaves it to the exact fallback
    // (is_accurate). The point as computed is off by 2 u of its terms at most.
    HWY_INLINE std::uint32_t ends_before_rest(std::uint32_t lanes) const {
        return by_halves(lanes, [&](std::size_t h, std::uint32_t) HWY_ATTR {
            const Doubles d;
            auto apart = hn::FirstN(d, 0);
            for (std::size_t a = 0; a < 3; ++a) {
                const auto o = hn::Load(d, origin_[a] + h), way = hn::Load(d, direction_[a] + h), end = hn::Add(o, way);
                const auto error = hn::Mul(hn::Add(hn::Abs(o), hn::Abs(way)), hn::Set(d, 4 * kRoundoff));
                const auto below = hn::Add(hn::Max(o, end), error), above = hn::Sub(hn::Min(o, end), error);
                apart = hn::Or(apart, hn::Or(hn::Lt(below, hn::Set(d, double{list_.rest_lower[a]})),
                                             hn::Gt(above, hn::Set(d, double{list_.rest_upper[a]}))));
            }
            return bits(d, hn::And(apart, hn::Lt(hn::Load(d, t_max_ + h), hn::Set(d, 1.0))));
        });
    }

    // The sure hits of some lanes.
    HWY_INLINE void take(std::uint32_t i, std::uint32_t certain, RV near, RV far) {
        const RayLanes d;
        if (certain == 0) return;
        if constexpr (Query::kFirstHit) {
            active_ &= ~certain;
            for (; certain != 0; certain &= certain - 1) queries_[std::countr_zero(certain)].report({}, 0, false);
        } else {
            const auto new_bound = hn::Min(hn::Load(d, bound_), hn::MulAdd(hn::Abs(far), hn::Set(d, 0x1p-22f), far));
            // Where the one before may still be the nearest it is asked now.
            const auto has_winner = hn::Ne(hn::Load(hn::RebindToUnsigned<RayLanes>(), winners_),
                                           hn::Set(hn::RebindToUnsigned<RayLanes>(), kNone));
            const std::uint32_t waiting = bits(hn::RebindToUnsigned<RayLanes>(), has_winner);
            const std::uint32_t both = certain & waiting & bits(d, hn::Le(hn::Load(d, near_), new_bound));
            for (std::uint32_t lanes = both; lanes != 0; lanes &= lanes - 1) {
                const auto r = static_cast<std::size_t>(std::countr_zero(lanes));
                ask(r, winners_[r]);
            }
            const hn::RebindToUnsigned<RayLanes> du;
            const auto taken = rays_mask(certain);
            hn::Store(hn::Min(hn::Load(d, bound_), hn::IfThenElse(taken, new_bound, hn::Load(d, bound_))), d, bound_);
            hn::Store(hn::IfThenElse(taken, near, hn::Load(d, near_)), d, near_);
            hn::Store(hn::IfThenElse(hn::RebindMask(du, taken), hn::Set(du, i), hn::Load(du, winners_)), du, winners_);
        }
    }

    static RM rays_mask(std::uint32_t lanes) {
        const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(lanes), static_cast<std::uint8_t>(lanes >> 8)};
        return hn::LoadMaskBits(RayLanes(), bytes);
    }

    using Doubles = hn::CappedTag<double, 8>;

    // visit(first lane, mask of lanes) for the lanes of each vector of doubles; its answers together.
    template <class Visit>
    HWY_INLINE static std::uint32_t by_halves(std::uint32_t lanes, const Visit& visit) {
        constexpr std::size_t kSome = hn::MaxLanes(Doubles());
        std::uint32_t result = 0;
        for (std::size_t h = 0; h < kPacket; h += kSome) {
            const std::uint32_t here = lanes >> h & ((1u << kSome) - 1);
            if (here != 0) result |= (visit(h, here) & here) << h;
        }
        return result;
    }

    // Those of the lanes whose origin the plane lies behind.
    HWY_INLINE std::uint32_t behind(const PrimitiveList::Entry& e, std::uint32_t lanes, std::uint32_t against) const {
        using N = limn::HWY_NAMESPACE::Doubles;
        return by_halves(lanes, [&](std::size_t h, std::uint32_t) HWY_ATTR {
            const auto at = [&](const double* row) HWY_ATTR { return load<N>(row + h); };
            return bits(
                is_behind(e, Vector<N>{at(origin_[0]), at(origin_[1]), at(origin_[2])}, mask_of<N>(against >> h)));
        });
    }

    // Those of the lanes that the filter decides; a hit is reported.
    HWY_NOINLINE std::uint32_t decide(std::uint32_t i, std::uint32_t lanes) {
        const PrimitiveList::Entry& e = list_.entries[i];
        std::uint32_t decided = 0;
        with_listed(scene_, e, [&]<template <class> class Predicate>(const Predicate<double>& shape) HWY_ATTR {
            const auto broadcast = in_lanes<limn::HWY_NAMESPACE::Doubles>(shape);
            decided = by_halves(lanes, [&](std::size_t h, std::uint32_t here)
                                           HWY_ATTR { return decide(broadcast, e.number, h, here); });
            return false;
        });
        return decided;
    }

    template <class Shape>
    HWY_INLINE std::uint32_t decide(const Shape& shape, std::uint64_t number, std::size_t h, std::uint32_t lanes) {
        using N = limn::HWY_NAMESPACE::Doubles;
        const auto at = [&](const double* row) HWY_ATTR { return load<N>(row + h); };
        const RayOf<N> ray{{at(origin_[0]), at(origin_[1]), at(origin_[2])},
                           {at(direction_[0]), at(direction_[1]), at(direction_[2])},
                           N(0.0),
                           N(0.0)};
        const FilterResult<N> r = shape.filter(typename Shape::Ray(ray), {at(t_min_), at(t_max_)});
        HWY_ALIGN double t[8], u[8], v[8];
        store(r.t, t), store(r.u, u), store(r.v, v);
        const std::uint32_t hits = bits(r.hit);
        for (std::uint32_t rest = hits & lanes; rest != 0; rest &= rest - 1) {
            const auto k = static_cast<std::size_t>(std::countr_zero(rest));
            queries_[h + k].report({t[k], u[k], v[k]}, number, false);
            note_limit(h + k);
        }
        return hits | bits(r.miss);
    }

    // After a report.
    void note_limit(std::size_t r) {
        const double limit = queries_[r].limit();
        t_max_[r] = limit;
        const float bound = above(static_cast<float>(limit));
        if (bound < bound_[r]) bound_[r] = bound;
        if (queries_[r].ended()) active_ &= ~(1u << r);
    }

    HWY_NOINLINE void ask(std::size_t r, std::uint32_t i) {
        ask_listed(scene_, list_.entries[i], RayFrame(rays_[r]), queries_[r]);
        note_limit(r);
    }

    const flat::Scene& scene_;
    const PrimitiveList& list_;
    const Ray* rays_;
    Query* queries_;
    std::uint32_t* winners_;
    std::size_t count_;
    std::uint32_t active_ = 0, odd_ = 0, leaving_ = 0;  // by lane
    HWY_ALIGN double origin_[3][kPacket], direction_[3][kPacket], t_min_[kPacket], t_max_[kPacket];
    HWY_ALIGN float o_[3][kPacket], d_[3][kPacket], reach_[kPacket], size_[kPacket], inverse_size_[kPacket];
    HWY_ALIGN float possible_after_[kPacket], certain_after_[kPacket], certain_before_[kPacket], bound_[kPacket],
        near_[kPacket];
};

}  // namespace limn::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
