// Searches the list with several rays of any directions: a ray in each lane. The include guard is per target, as
// Highway requires.
#if defined(LIMN_TRACE_LIST_PACKET_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_TRACE_LIST_PACKET_INL_H
#undef LIMN_TRACE_LIST_PACKET_INL_H
#else
#define LIMN_TRACE_LIST_PACKET_INL_H
#endif

#include <tuple>

#include "geometry/sphere_side.h"
#include "trace/list-inl.h"
#include "trace/queries.h"

HWY_BEFORE_NAMESPACE();
namespace limn::trace::HWY_NAMESPACE {

// A listed primitive that a ray in world space surely hits.
struct DeferredHit {
    const PrimitiveList::Entry* entry;
    const Ray* ray;
    Closest* query;
};

// Sure hits of shapes of one kind, in columns. The filter decides them in vectors.
template <template <class> class Predicate>
class DeferredShapes {
public:
    DeferredShapes() : size_(0) {}  // the columns are not initialised

    bool is_full() const { return size_ == kSize; }

    // Adds a hit. `frame` is that of the ray in the space of the shape.
    HWY_INLINE void add(const Predicate<double>& shape, const RayFrame& frame, const DeferredHit& hit) {
        const double of_ray[kRay] = {frame.ray.origin.x,    frame.ray.origin.y,    frame.ray.origin.z,
                                     frame.ray.direction.x, frame.ray.direction.y, frame.ray.direction.z,
                                     frame.origin_error,    frame.direction_error, frame.ray.t_min,
                                     frame.ray.t_max};
        for (std::size_t k = 0; k < kRay; ++k) ray_[k][size_] = of_ray[k];
        // Copy the numbers one by one: a vector could not be loaded from numbers that have just been stored.
        [&]<std::size_t... k>(std::index_sequence<k...>) HWY_ATTR {
            ((shape_[k][size_] = number_of<double>(shape, k)), ...);
        }
        (std::make_index_sequence<Predicate<double>::kNumbers>());
        hits_[size_++] = hit;
    }

    // Reports all hits to their queries, and empties the columns. What the filter leaves undecided is intersected
    // exactly.
    HWY_INLINE void flush(const flat::Scene& scene) {
        // Fill the last vector with copies.
        constexpr std::size_t kWidth = kLanes<Doubles>;
        for (std::size_t i = size_; i % kWidth != 0; ++i) {
            for (auto& row : ray_) row[i] = row[size_ - 1];
            for (auto& row : shape_) row[i] = row[size_ - 1];
        }
        // Run the filter, and report.
        for (std::size_t i = 0; i < size_; i += kWidth) {
            const auto of_ray = [&](std::size_t k) HWY_ATTR { return load<Doubles>(ray_[k] + i); };
            const auto of_shape = [&](std::size_t k) HWY_ATTR { return load<Doubles>(shape_[k] + i); };
            const RayOf<Doubles> ray{three<Doubles>(of_ray, 0), three<Doubles>(of_ray, 3), of_ray(6), of_ray(7)};
            const auto shape = Predicate<Doubles>::from(of_shape);
            const FilterResult<Doubles> r = shape.filter(typename Predicate<Doubles>::Ray(ray), {of_ray(8), of_ray(9)});
            HWY_ALIGN double t[kWidth], u[kWidth], v[kWidth];
            store(r.t, t);
            store(r.u, u);
            store(r.v, v);
            const std::uint32_t hits = bits(r.hit), decided = hits | bits(r.miss);
            for (std::size_t k = 0; k < kWidth && i + k < size_; ++k) {
                const DeferredHit& hit = hits_[i + k];
                if ((hits >> k & 1) != 0)
                    hit.query->report({t[k], u[k], v[k]}, hit.entry->number, false);
                else if ((decided >> k & 1) == 0)
                    intersect_listed(scene, *hit.entry, RayFrame(*hit.ray), *hit.query);
            }
        }
        size_ = 0;
    }

private:
    // A multiple of the lanes, and small enough for the first-level cache (docs/tried.md).
    static constexpr std::size_t kSize = 16, kRay = 10;

    std::size_t size_;
    HWY_ALIGN double ray_[kRay][kSize], shape_[Predicate<double>::kNumbers][kSize];
    DeferredHit hits_[kSize];
};

// The sure hits of a batch.
class DeferredHits {
public:
    explicit DeferredHits(const flat::Scene& scene) : scene_(scene) {}

    template <template <class> class Predicate>
    HWY_INLINE void add(const Predicate<double>& shape, const RayFrame& frame, const DeferredHit& hit) {
        auto& shapes = std::get<DeferredShapes<Predicate>>(shapes_);
        shapes.add(shape, frame, hit);
        if (shapes.is_full()) shapes.flush(scene_);
    }

    // Reports the hits that are left.
    HWY_INLINE void finish() {
        std::apply([&](auto&... shapes) HWY_ATTR { (shapes.flush(scene_), ...); }, shapes_);
    }

private:
    const flat::Scene& scene_;
    std::tuple<DeferredShapes<QuadPredicate>, DeferredShapes<TrianglePredicate>, DeferredShapes<SpherePredicate>>
        shapes_;
};

// Up to kPacket rays against the list. Query is Closest or Any; each ray has its own. As in Traversal sure hits wait,
// because only the nearest has to be intersected exactly.
template <class Query>
class ListPacket {
public:
    // The arguments must outlive this object. \pre 0 < count <= kPacket
    ListPacket(const flat::Scene& scene, const Ray* rays, std::size_t count, Query* queries)
        : scene_(scene), list_(scene.list), rays_(rays), queries_(queries), count_(count) {
        for (std::size_t i = 0; i < kPacket; ++i) {
            const Ray& ray = rays[i < count ? i : 0];
            for (std::size_t a = 0; a < 3; ++a) {
                origin_[a][i] = ray.origin[a];
                direction_[a][i] = ray.direction[a];
            }
            t_min_[i] = ray.t_min;
            t_max_[i] = i < count ? queries[i].limit() : -kInfinity;
        }
    }

    // Searches the list. Returns the lanes whose rays may hit what is not in the list.
    std::uint32_t run() {
        // Round the rays to float.
        const auto limited = [](const double* t)
                                 HWY_ATTR { return max(-kMostListed, min(load_rounded<RayFloats>(t), kMostListed)); };
        const auto in_float = [](const double(&v)[3][kPacket]) HWY_ATTR {
            return three<RayFloats>([&](std::size_t a) HWY_ATTR { return load_rounded<RayFloats>(v[a]); }, 0);
        };
        const RayFloats t_min = limited(t_min_);
        const ListLimits limits(t_min, limited(t_max_));
        const auto extent = static_cast<float>(flat::blas_at(scene_, BlasId::root).extent);
        const ListRay ray(in_float(origin_), in_float(direction_), extent);
        store(limits.bound, bound_);
        const std::uint32_t there = (1u << count_) - 1;
        active_ = bits(ray.is_ordinary) & there;
        const std::uint32_t unusual = there & ~active_;
        leaving_ = bits(t_min >= 0.0f);

        // Test planar primitives, then spheres.
        const auto none = first_lanes<RayFloats>(0);
        for (std::uint32_t i = 0; i < list_.quads && active_ != 0; ++i) planar(i, none, ray, limits);
        for (std::uint32_t i = list_.quads; i < list_.planars() && active_ != 0; ++i) planar(i, !none, ray, limits);
        if (list_.spheres != 0) {
            const auto ray_of_spheres = sphere_ray(ray);
            for (std::uint32_t i = 0; i < list_.spheres && active_ != 0; ++i) sphere(i, ray_of_spheres, limits);
        }
        std::uint32_t rest = list_.is_all ? 0 : active_ & meets_rest(ray, limits);
        for (std::size_t r = 0; r < count_; ++r)
            if ((unusual >> r & 1) != 0 && !intersect_all_listed(scene_, RayFrame(rays_[r]), queries_[r]))
                rest |= 1u << r;
        return list_.is_all ? 0 : rest;
    }

    // Adds the sure hits that may be the nearest to `deferred`. \pre run() was called
    void defer_candidates(DeferredHits& deferred) {
        for (std::uint32_t lanes = waiting_; lanes != 0; lanes &= lanes - 1) {
            const auto r = static_cast<std::size_t>(std::countr_zero(lanes));
            const PrimitiveList::Entry& e = list_.entries[static_cast<std::size_t>(candidate_[r])];
            Query& query = queries_[r];
            query.lower_limit(double{bound_[r]});
            as_seen(scene_, e, RayFrame(rays_[r]), [&](const auto& shape, const RayFrame& frame) HWY_ATTR {
                deferred.add(shape, frame, {&e, &rays_[r], &query});
                return false;
            });
        }
    }

private:
    // Returns the lanes whose rays meet the bounds of what is not in the list. These are widened as those of WalkRay,
    // with the same widening for all axes.
    HWY_INLINE std::uint32_t meets_rest(const ListRay& ray, const ListLimits& limits) const {
        RayFloats enter = limits.possible_after, leave = load<RayFloats>(bound_);
        const RayFloats wider = WalkRay::kWider * ray.reach;
        const auto cut = [&](RayFloats o, RayFloats direction, std::size_t a) HWY_ATTR {
            const RayFloats inverse = 1.0f / copy_sign(max(abs(direction), WalkRay::kLeast), direction);
            const RayFloats shift = -(o * inverse), widening = wider * abs(inverse);
            const RayFloats lower = mul_add(list_.rest_lower[a], inverse, shift);
            const RayFloats upper = mul_add(list_.rest_upper[a], inverse, shift);
            enter = max(enter, min(lower, upper) - widening);
            leave = min(leave, max(lower, upper) + widening);
        };
        cut(ray.origin.x, ray.direction.x, 0);
        cut(ray.origin.y, ray.direction.y, 1);
        cut(ray.origin.z, ray.direction.z, 2);
        return bits(enter <= leave);
    }

    HWY_INLINE void planar(std::uint32_t i, Mask<RayFloats> is_triangle, const ListRay& ray, ListLimits limits) {
        const float* rows = list_.planar.data() + i;
        const std::size_t stride = list_.planar_stride;
        limits.bound = load<RayFloats>(bound_);
        const auto hits = test_listed_plane([&](std::size_t r) HWY_ATTR { return RayFloats(rows[r * stride]); },
                                            is_triangle, ray, limits);
        const std::uint32_t possible = bits(hits.possible) & active_;
        if (possible == 0) return;
        std::uint32_t certain = bits(hits.certain) & possible;
        if (certain != possible) {
            std::uint32_t undecided = possible & ~certain;
            // A ray starts on a surface and leaves it. A shadow ray ends just before the light.
            const std::uint32_t leaving = undecided & leaving_ & bits(hits.may_be_behind());
            if (leaving != 0) undecided &= ~behind(list_.entries[i], leaving, bits(hits.along < 0.0f));
            const std::uint32_t within = undecided & bits(hits.inside);
            if (within != 0 && !list_.entries[i].is_instanced) undecided &= ~decide(i, within);
            for (; undecided != 0; undecided &= undecided - 1)
                intersect(static_cast<std::size_t>(std::countr_zero(undecided)), i);
            certain &= active_;
        }
        if (certain != 0) take(i, certain, hits.near, hits.far);
    }

    HWY_INLINE void sphere(std::uint32_t i, const SphereFloatRay<RayFloats>& ray, ListLimits limits) {
        const float* rows = list_.round.data() + i;
        const std::size_t stride = list_.sphere_stride;
        limits.bound = load<RayFloats>(bound_);
        const auto roots = listed_roots([&](std::size_t r) HWY_ATTR { return RayFloats(rows[r * stride]); }, ray);
        if (!any(!roots.missed)) return;
        auto hits = first_listed(roots, limits);
        const std::uint32_t possible = bits(hits.possible) & active_, index = list_.planars() + i;
        if (possible == 0) return;
        std::uint32_t certain = bits(hits.certain) & possible;
        if (certain != possible) {
            const PrimitiveList::Entry& e = list_.entries[index];
            const std::uint32_t ahead = bits(roots.certain & (roots.near_last > limits.certain_after) &
                                             (roots.far_last < limits.certain_before));
            std::uint32_t within = 0;
            for (std::uint32_t rest = possible & ~certain; rest != 0; rest &= rest - 1) {
                const auto r = static_cast<std::size_t>(std::countr_zero(rest));
                const Side side = (leaving_ >> r & 1) != 0 ? side_of(e.corner, e.radius, rays_[r]) : Side::unknown;
                if (side == Side::inside && (ahead >> r & 1) != 0)
                    within |= 1u << r;
                else if (side != Side::missed)
                    intersect(r, index);
            }
            hits.near = select(mask_of<RayFloats>(within), roots.near_last, hits.near);
            hits.far = select(mask_of<RayFloats>(within), roots.far_last, hits.far);
            certain = (certain | within) & active_;
        }
        if (certain != 0) take(index, certain, hits.near, hits.far);
    }

    // Takes the sure hits of the lanes `certain` with primitive i.
    HWY_INLINE void take(std::uint32_t i, std::uint32_t certain, RayFloats near, RayFloats far) {
        if constexpr (Query::kFirstHit) {
            active_ &= ~certain;
            for (; certain != 0; certain &= certain - 1) queries_[std::countr_zero(certain)].report({}, 0, false);
        } else {
            const auto bound = load<RayFloats>(bound_), new_bound = min(bound, above(far));
            // If the sure hit before it may still be the nearest, intersect that now.
            const std::uint32_t both = certain & waiting_ & bits(load<RayFloats>(near_) <= new_bound);
            for (std::uint32_t lanes = both; lanes != 0; lanes &= lanes - 1) {
                const auto r = static_cast<std::size_t>(std::countr_zero(lanes));
                intersect(r, static_cast<std::uint32_t>(candidate_[r]));
            }
            const auto taken = mask_of<RayFloats>(certain);
            store(min(load<RayFloats>(bound_), select(taken, new_bound, bound)), bound_);
            store(select(taken, near, load<RayFloats>(near_)), near_);
            store(select(taken, RayFloats(static_cast<float>(i)), load<RayFloats>(candidate_)), candidate_);
            waiting_ |= certain;
        }
    }

    // Calls visit(first lane, mask of lanes) for each vector of doubles, and returns the results as one mask.
    template <class Visit>
    HWY_INLINE static std::uint32_t by_halves(std::uint32_t lanes, const Visit& visit) {
        constexpr std::size_t kSome = kLanes<Doubles>;
        std::uint32_t result = 0;
        for (std::size_t h = 0; h < kPacket; h += kSome) {
            const std::uint32_t here = lanes >> h & ((1u << kSome) - 1);
            if (here != 0) result |= (visit(h, here) & here) << h;
        }
        return result;
    }

    HWY_INLINE static Vector<Doubles> doubles(const double (&v)[3][kPacket], std::size_t h) {
        return {load<Doubles>(v[0] + h), load<Doubles>(v[1] + h), load<Doubles>(v[2] + h)};
    }

    // Returns the lanes of whose origin the plane is surely behind.
    HWY_INLINE std::uint32_t behind(const PrimitiveList::Entry& e, std::uint32_t lanes, std::uint32_t against) const {
        return by_halves(lanes, [&](std::size_t h, std::uint32_t) HWY_ATTR {
            return bits(is_behind(e, doubles(origin_, h), mask_of<Doubles>(against >> h)));
        });
    }

    // Runs the filter, and reports hits. Returns the lanes that it decides.
    HWY_NOINLINE std::uint32_t decide(std::uint32_t i, std::uint32_t lanes) {
        const PrimitiveList::Entry& e = list_.entries[i];
        std::uint32_t decided = 0;
        with_listed(scene_, e, [&]<template <class> class Predicate>(const Predicate<double>& shape) HWY_ATTR {
            const auto broadcast = in_lanes<Doubles>(shape);
            decided = by_halves(lanes, [&](std::size_t h, std::uint32_t here)
                                           HWY_ATTR { return decide(broadcast, e.number, h, here); });
            return false;
        });
        return decided;
    }
    template <class Shape>
    HWY_INLINE std::uint32_t decide(const Shape& shape, std::uint64_t number, std::size_t h, std::uint32_t lanes) {
        const RayOf<Doubles> ray{doubles(origin_, h), doubles(direction_, h), 0.0, 0.0};
        const FilterResult<Doubles> r =
            shape.filter(typename Shape::Ray(ray), {load<Doubles>(t_min_ + h), load<Doubles>(t_max_ + h)});
        HWY_ALIGN double t[8], u[8], v[8];
        store(r.t, t);
        store(r.u, u);
        store(r.v, v);
        const std::uint32_t hits = bits(r.hit);
        for (std::uint32_t rest = hits & lanes; rest != 0; rest &= rest - 1) {
            const auto k = static_cast<std::size_t>(std::countr_zero(rest));
            queries_[h + k].report({t[k], u[k], v[k]}, number, false);
            note_limit(h + k);
        }
        return hits | bits(r.miss);
    }

    // Updates the lane of a ray after a report to its query.
    void note_limit(std::size_t r) {
        const double limit = queries_[r].limit();
        t_max_[r] = limit;
        const float bound = above(static_cast<float>(limit));
        if (bound < bound_[r]) bound_[r] = bound;
        if (queries_[r].ended()) active_ &= ~(1u << r);
    }

    HWY_NOINLINE void intersect(std::size_t r, std::uint32_t i) {
        intersect_listed(scene_, list_.entries[i], RayFrame(rays_[r]), queries_[r]);
        note_limit(r);
    }

    const flat::Scene& scene_;
    const PrimitiveList& list_;
    const Ray* rays_;
    Query* queries_;
    std::size_t count_;
    std::uint32_t active_ = 0, leaving_ = 0, waiting_ = 0;  // masks of lanes
    HWY_ALIGN double origin_[3][kPacket], direction_[3][kPacket], t_min_[kPacket], t_max_[kPacket];
    HWY_ALIGN float bound_[kPacket], near_[kPacket], candidate_[kPacket];
};

}  // namespace limn::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
