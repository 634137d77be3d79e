// Hits that are sure, and whose t, u and v are worked out at the end of a batch, in lanes. Per-target include guard, as
// Highway has it.
#if defined(LIMN_TRACE_DEFERRED_HITS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_TRACE_DEFERRED_HITS_INL_H
#undef LIMN_TRACE_DEFERRED_HITS_INL_H
#else
#define LIMN_TRACE_DEFERRED_HITS_INL_H
#endif

#include <bit>
#include <tuple>

#include "trace/queries.h"
#include "trace/shapes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::trace::HWY_NAMESPACE {

// Rays and the shapes of one kind that they hit, in columns.
template <template <class> class Predicate>
class DeferredShapes {
public:
    DeferredShapes() : size_(0) {}  // the rest is left as it is

    bool is_full() const { return size_ == kSize; }

    HWY_INLINE void add(const Predicate<double>& shape, const RayFrame& frame, Closest& query, std::uint64_t number) {
        const double of_ray[kRay] = {frame.ray.origin.x,    frame.ray.origin.y,    frame.ray.origin.z,
                                     frame.ray.direction.x, frame.ray.direction.y, frame.ray.direction.z,
                                     frame.origin_error,    frame.direction_error, frame.ray.t_min,
                                     frame.ray.t_max};
        for (std::size_t k = 0; k < kRay; ++k) ray_[k][size_] = of_ray[k];
        // One by one: wide loads would wait for what has just been stored in parts.
        [&]<std::size_t... k>(std::index_sequence<k...>) HWY_ATTR {
            ((shape_[k][size_] = number_of<double>(shape, k)), ...);
        }
        (std::make_index_sequence<Predicate<double>::kNumbers>());
        query_[size_] = &query, number_[size_++] = number;
    }

    // Reports to the queries; undecided(query) for those that the filter leaves so. Empties the columns.
    template <class Undecided>
    HWY_INLINE void flush(const Undecided& undecided) {
        constexpr std::size_t kWidth = kLanes<Doubles>;
        for (std::size_t i = size_; i % kWidth != 0; ++i) {  // what fills the last lanes
            for (auto& row : ray_) row[i] = row[size_ - 1];
            for (auto& row : shape_) row[i] = row[size_ - 1];
        }
        for (std::size_t i = 0; i < size_; i += kWidth) {
            const auto of_ray = [&](std::size_t k) HWY_ATTR { return load<Doubles>(ray_[k] + i); };
            const auto of_shape = [&](std::size_t k) HWY_ATTR { return load<Doubles>(shape_[k] + i); };
            const RayOf<Doubles> ray{three<Doubles>(of_ray, 0), three<Doubles>(of_ray, 3), of_ray(6), of_ray(7)};
            const auto shape = Predicate<Doubles>::from(of_shape);
            const FilterResult<Doubles> r = shape.filter(typename Predicate<Doubles>::Ray(ray), {of_ray(8), of_ray(9)});
            HWY_ALIGN double t[kWidth], u[kWidth], v[kWidth];
            store(r.t, t), store(r.u, u), store(r.v, v);
            const std::uint32_t hits = bits(r.hit), decided = hits | bits(r.miss);
            for (std::size_t k = 0; k < kWidth && i + k < size_; ++k) {
                if ((hits >> k & 1) != 0)
                    query_[i + k]->report({t[k], u[k], v[k]}, number_[i + k], false);
                else if ((decided >> k & 1) == 0)
                    undecided(*query_[i + k]);
            }
        }
        size_ = 0;
    }

private:
    // Whole vectors, and few enough that they leave the first-level cache to what rays read: with 64, second bounces on
    // 2 M triangles went at 0.93 of the rate (docs/tried.md).
    static constexpr std::size_t kSize = 16, kRay = 10;

    std::size_t size_;
    HWY_ALIGN double ray_[kRay][kSize], shape_[Predicate<double>::kNumbers][kSize];
    Closest* query_[kSize];
    std::uint64_t number_[kSize];
};

// Of a batch, whose queries are `queries`.
class DeferredHits {
public:
    explicit DeferredHits(const Closest* queries) : queries_(queries) {}

    // `frame`: as the shape sees the ray. It may be gone when the hit is reported.
    template <template <class> class Predicate>
    HWY_INLINE void add(const Predicate<double>& shape, const RayFrame& frame, Closest& query, std::uint64_t number) {
        auto& shapes = std::get<DeferredShapes<Predicate>>(shapes_);
        shapes.add(shape, frame, query, number);
        if (shapes.is_full()) flush(shapes);
    }

    // Reports what is left. search_again(i) for the queries of which one was not decided in lanes.
    template <class SearchAgain>
    HWY_INLINE void finish(std::size_t count, const SearchAgain& search_again) {
        std::apply([&](auto&... shapes) HWY_ATTR { (flush(shapes), ...); }, shapes_);
        for (std::size_t i = 0; are_undecided_ && i < count; ++i)
            if (is_undecided_[i]) search_again(i);
    }

private:
    template <class Shapes>
    HWY_INLINE void flush(Shapes& shapes) {
        shapes.flush([&](const Closest& query) {
            if (!are_undecided_) std::fill_n(is_undecided_, kMostRays, false);
            are_undecided_ = is_undecided_[&query - queries_] = true;
        });
    }

    const Closest* queries_;
    bool are_undecided_ = false, is_undecided_[kMostRays];
    std::tuple<DeferredShapes<QuadPredicate>, DeferredShapes<TrianglePredicate>, DeferredShapes<SpherePredicate>>
        shapes_;
};

}  // namespace limn::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
