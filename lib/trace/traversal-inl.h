// One ray through one BLAS. Per-target include guard, as Highway has it.
#if defined(LIMN_TRACE_TRAVERSAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_TRACE_TRAVERSAL_INL_H
#undef LIMN_TRACE_TRAVERSAL_INL_H
#else
#define LIMN_TRACE_TRAVERSAL_INL_H
#endif

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

#include "geometry/sphere_side.h"
#include "trace/box_ray-inl.h"
#include "trace/deferred_hits-inl.h"
#include "trace/node-inl.h"
#include "trace/queries.h"
#include "trace/report-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::trace::HWY_NAMESPACE {

// kKinds: the primitive kinds that the scene has; code for the others is left out.
//
// Boxes and packed primitives are tested in float. What those tests leave undecided is intersected exactly at once. Of
// hits that they are sure of, `bound_` keeps a t that none of interest lies beyond, and only those that may be the
// nearest are intersected exactly, at the end: mostly one.
template <unsigned kKinds, class Query>
class Traversal {
public:
    // `ray`, which is the frame's, `frame` and `query` are kept by reference. `deferred` takes the sure hits of a
    // batch, and is null for single rays.
    HWY_INLINE Traversal(const flat::Scene& scene, const flat::Blas& blas, const BoxRay& ray, const RayFrame& frame,
                         std::uint64_t first_number, Query& query, DeferredHits* deferred)
        : scene_(scene),
          blas_(blas),
          frame_(frame),
          box_ray_(ray),
          first_number_(first_number),
          query_(query),
          deferred_(deferred),
          node_test_(ray),
          bound_(box_ray_.upper(query.limit())),
          possible_after_(below(box_ray_.t_min)),
          certain_after_(above(box_ray_.lower(larger(frame.ray.t_min, -kEndless)) + 2 * box_ray_.t_error)),
          certain_before_(below(box_ray_.upper(limn::smaller(query.limit(), kEndless)) - 2 * box_ray_.t_error)) {
        if constexpr (has_planar()) planar_ = PlanarRay(box_ray_, packed_error());
        if constexpr (has_spheres()) round_ = sphere_ray(box_ray_, packed_error());
    }

    // A part of run(), which ends where memory is about to be waited for. False at the end. `stack` and `next`, at
    // first empty and the root, are the caller's.
    HWY_INLINE bool advance(Stack& stack, flat::Child& next) {
        for (;;) {
            if (!(next & flat::kLeaf)) {
                next = node_test_.visit(scene_, next, bound_, stack);
                if (next != flat::kNothing) {
                    prefetch(scene_, next);
                    return true;
                }
            } else if (next != flat::kNothing && leaf(next)) {
                return false;
            }
            if (!stack.pop(bound_, next)) {
                finish();
                return false;
            }
        }
    }

    // True if the query ended the search.
    bool run() {
        if (blas_.root == flat::kNothing) return false;
        Stack::Rows rows;
        Stack stack(rows);
        flat::Child next = blas_.root;
        for (;;) {
            while (!(next & flat::kLeaf)) next = node_test_.visit(scene_, next, bound_, stack);
            if (next != flat::kNothing && leaf(next)) return true;
            if (!stack.pop(bound_, next)) {
                finish();
                return false;
            }
        }
    }

private:
    static constexpr bool has(PrimitiveKind kind) { return (kKinds & flat::bit(kind)) != 0; }
    static constexpr unsigned kRoundKinds = flat::bit(PrimitiveKind::sphere) | flat::bit(PrimitiveKind::moving_sphere);
    static constexpr bool has_planar() { return (kKinds & flat::kPlanarKinds) != 0; }
    static constexpr bool has_spheres() { return (kKinds & kRoundKinds) != 0; }
    // Where t may overflow, and a hit be none.
    static constexpr double kEndless = 1e300;
    float packed_error() const { return kKinds == flat::bit(PrimitiveKind::mesh) ? 0 : blas_.packed_error; }

    // A hit for sure, not intersected exactly yet.
    struct Pending {
        flat::BlockView block;
        std::uint32_t lane;
        float near;
    };
    // Of n hits in random order ln n + 0.6, on average, are nearer than all before: 8 of 1,700. A full list is only
    // intersected earlier.
    static constexpr std::size_t kMaxPending = 8;

    HWY_INLINE bool leaf(flat::Child child) {
        flat::BlockView block{scene_.blocks.data() + std::size_t{2} * (child & ~flat::kLeaf)};
        for (;;) {
            const flat::Block header = block.header();
            if (test(block, header)) return true;
            if (header.last) return false;
            block.words += flat::words_of(header.kind, header.count);
        }
    }

    // Nothing is compared that the set of kinds tells.
    static constexpr bool is(const flat::Block& header, PrimitiveKind kind) {
        return kKinds == flat::bit(kind) || (has(kind) && header.kind == kind);
    }

    HWY_INLINE bool test(const flat::BlockView& block, const flat::Block& header) {
        if constexpr (has(PrimitiveKind::mesh) || has(PrimitiveKind::triangle))
            if (is(header, PrimitiveKind::mesh) || is(header, PrimitiveKind::triangle))
                return take(test_planar<false>(block, header.count, *planar_, possible_after_, above(bound_)), block);
        if constexpr (has(PrimitiveKind::quad))
            if (is(header, PrimitiveKind::quad))
                return take(test_planar<true>(block, header.count, *planar_, possible_after_, above(bound_)), block);
        if constexpr (has(PrimitiveKind::sphere))
            if (is(header, PrimitiveKind::sphere))
                return take(test_spheres<false>(block, header.count, *round_, 0, possible_after_, certain_after_,
                                                above(bound_)),
                            block);
        if constexpr (has(PrimitiveKind::moving_sphere))
            if (is(header, PrimitiveKind::moving_sphere))
                return take(test_spheres<true>(block, header.count, *round_, time(), possible_after_, certain_after_,
                                               above(bound_)),
                            block);
        if constexpr ((kKinds & ~(flat::kPlanarKinds | kRoundKinds)) != 0)
            return intersect_boxes(block, header.count);
        else
            return false;
    }

    // As interpolate() clamps it.
    float time() const { return static_cast<float>(std::clamp(frame_.ray.time, 0.0, 1.0)); }

    HWY_INLINE bool take(const Candidates& found, const flat::BlockView& block) {
        for (std::uint32_t possible = found.possible; possible != 0; possible &= possible - 1) {
            const auto lane = static_cast<std::uint32_t>(std::countr_zero(possible));
            const bool certain = (found.certain >> lane & 1) != 0 && found.near[lane] > certain_after_ &&
                                 found.far[lane] < certain_before_;
            if (certain && Query::kFirstHit) return query_.report({}, 0, false);
            if (certain && Query::kNearest) {
                if (found.near[lane] > above(bound_)) continue;  // another lane's hit is nearer
                bound_ = smaller(bound_, above(found.far[lane] + box_ray_.t_error));
                postpone({block, lane, found.near[lane]});
            } else if (intersect_in_block(block, lane)) {
                return true;
            }
        }
        return false;
    }

    // One by one, the nearest box first.
    bool intersect_boxes(const flat::BlockView& block, std::size_t count) {
        const Candidates found = node_test_.test_boxes(block, count, bound_);
        for (std::uint32_t possible = found.possible; possible != 0;) {
            auto next = static_cast<std::uint32_t>(std::countr_zero(possible));
            for (std::uint32_t rest = possible & (possible - 1); rest != 0; rest &= rest - 1) {
                const auto other = static_cast<std::uint32_t>(std::countr_zero(rest));
                if (found.near[other] < found.near[next]) next = other;
            }
            if (found.near[next] > bound_) return false;
            if (intersect_in_block(block, next)) return true;
            possible &= ~(1u << next);
        }
        return false;
    }

    static float smaller(float a, float b) { return a < b ? a : b; }

    HWY_INLINE void postpone(const Pending& hit) {
        if (pending_count_ == kMaxPending) intersect_pending();
        pending_[pending_count_++] = hit;
    }

    // Makes the query's limit say all that is known, before an instance's inside or a user-defined shape reads it. In
    // between `bound_` is ahead of it, by the hits that are pending.
    void update_limit() {
        if constexpr (Query::kNearest) {
            if (box_ray_.is_taken_as_it_is)
                query_.lower_limit(double{above(bound_)});
            else
                intersect_pending();
        }
    }

    // Nothing is left to be visited.
    void finish() {
        if constexpr (Query::kNearest) {
            is_deferring_ = deferred_ != nullptr && box_ray_.is_taken_as_it_is;
            if (is_deferring_) query_.lower_limit(double{above(bound_)});
            intersect_pending();
        }
    }

    void intersect_pending() {
        for (std::size_t i = 0; i < pending_count_; ++i) {
            const Pending& hit = pending_[i];
            if (hit.near <= above(bound_)) intersect_in_block(hit.block, hit.lane);
        }
        pending_count_ = 0;
    }

    // Exactly. Reads the header again: who tests blocks need not keep it.
    bool intersect_in_block(const flat::BlockView& block, std::uint32_t lane) {
        const flat::Block header = block.header();
        const std::uint32_t id = block.id(lane);
        bool end = false;
        if constexpr (has(PrimitiveKind::mesh)) {
            if (header.kind == PrimitiveKind::mesh) {
                const TriangleVertices v = flat::packed_triangle(block, header.count, lane);
                end = intersect_shape(triangle_of<double>(v.a, v.b, v.c),
                                      first_number_ + scene_.ranges[header.range].first_number + id);
            }
        }
        if constexpr (kKinds != flat::bit(PrimitiveKind::mesh)) {
            if (header.kind != PrimitiveKind::mesh) end = intersect_reference(scene_.references[id]);
        }
        bound_ = smaller(bound_, box_ray_.upper(query_.limit()));
        return end;
    }

    bool intersect_reference(const flat::Reference& reference) {
        const PrimitiveRange& range = scene_.ranges[reference.range];
        const std::uint64_t number = first_number_ + range.first_number + reference.element;
        const std::uint32_t row = range.first_row + reference.element;
        if constexpr (has(PrimitiveKind::instance)) {
            if (range.kind == PrimitiveKind::instance) {
                const flat::Instance& instance = scene_.instances[range.first_row];
                update_limit();
                return inside(instance, frame_, [&](const RayFrame& frame) {
                    return is_usable(frame.ray) && run_inside(flat::blas_at(scene_, instance.blas), frame, number);
                });
            }
        }
        if constexpr (has(PrimitiveKind::user_defined)) {
            if (range.kind == PrimitiveKind::user_defined) {
                update_limit();
                return intersect_user_defined(scene_.user_defined[row], number);
            }
        }
        constexpr unsigned kOthers = kKinds & ~flat::bit(PrimitiveKind::mesh);  // see above
        return with_shape<kOthers>(scene_, range.kind, row, 0, frame_.ray.time,
                                   [&](const auto& shape) { return intersect_shape(shape, number); });
    }

    bool run_inside(const flat::Blas& blas, const RayFrame& frame, std::uint64_t number) {
        BoxRay ray;
        set_up(frame.ray, frame, blas, ray);
        return Traversal(scene_, blas, ray, frame, number, query_, deferred_).run();
    }

    template <class Shape>
    HWY_INLINE bool defer(const Shape& shape, std::uint64_t number) {
        if constexpr (Query::kNearest) {
            if (is_deferring_) deferred_->add(shape, frame_, query_, number);
            return is_deferring_;
        }
        return false;
    }

    template <class Shape>
    HWY_NOINLINE bool intersect_shape(const Shape& shape, std::uint64_t number) {
        return !defer(shape, number) && report_hits(shape, frame_, number, query_);
    }
    template <class Kind>
    HWY_NOINLINE bool intersect_shape(std::reference_wrapper<const Kind> row, std::uint64_t number) {
        return report_hits(row, frame_, number, query_);
    }
    HWY_NOINLINE bool intersect_shape(const SpherePredicate<double>& sphere, std::uint64_t number) {
        if constexpr (!Query::kEveryHit) {
            if (defer(sphere, number)) return false;
            const Ray& ray = frame_.ray;
            const Point3 center{sphere.center.x, sphere.center.y, sphere.center.z};
            if (frame_.outer == nullptr && ray.t_min >= 0 &&
                side_of(center, std::abs(sphere.radius), ray) == Side::missed)
                return false;
        }
        return report_hits(sphere, frame_, number, query_);
    }

    bool intersect_user_defined(const flat::UserDefined& shape, std::uint64_t number) {
        Ray rest = frame_.with_frame();  // it may consist of limn's own shapes
        rest.t_max = query_.limit();
        UserDefinedHit hit;
        while (shape.hit(*shape.object, rest, hit)) {
            if (!(hit.t > rest.t_min && hit.t <= rest.t_max)) return false;  // not what hit() promises: a miss
            const bool passes = query_.passes(hit);
            const bool inward = Query::kEveryHit && dot(Vec3(hit.normal), frame_.ray.direction) < 0;
            if (!passes && query_.report({hit.t, hit.u, hit.v}, number, inward, hit.index_matched)) return true;
            if (!passes && !Query::kEveryHit) return false;
            rest.t_min = hit.t;
        }
        return false;
    }

    const flat::Scene& scene_;
    const flat::Blas& blas_;
    const RayFrame& frame_;
    const BoxRay& box_ray_;
    std::optional<PlanarRay> planar_;
    std::optional<SphereFloatRay<float>> round_;
    const std::uint64_t first_number_;
    Query& query_;
    DeferredHits* const deferred_;
    const NodeTest node_test_;
    float bound_;  // in BoxRay's t: no hit of interest is beyond
    // By t_min and t_max: hits before the first do not count, those that lie between the others do.
    const float possible_after_, certain_after_, certain_before_;
    std::size_t pending_count_ = 0;
    bool is_deferring_ = false;  // what is intersected from now on
    Pending pending_[kMaxPending];
};

}  // namespace limn::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
