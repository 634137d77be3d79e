// One ray through one group. Per-target include guard, as Highway has it.
#if defined(LIMN_KERNELS_TRAVERSAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_KERNELS_TRAVERSAL_INL_H
#undef LIMN_KERNELS_TRAVERSAL_INL_H
#else
#define LIMN_KERNELS_TRAVERSAL_INL_H
#endif

#include <utility>

#include "core/sphere_uv.h"
#include "kernels/box_ray-inl.h"
#include "kernels/exact_filters-inl.h"
#include "kernels/exact_tests.h"
#include "kernels/node-inl.h"
#include "kernels/planar-inl.h"
#include "kernels/queries.h"
#include "kernels/sphere-inl.h"
#include "predicates/sphere_side.h"

HWY_BEFORE_NAMESPACE();
namespace limn::kernels::HWY_NAMESPACE {

// kKinds: the primitive kinds that the scene has; code for the others is left out.
//
// Boxes and packed primitives are tested in float. What those tests leave open is asked exactly at once. Of hits that
// they are sure of, `bound_` keeps a t that none of interest lies beyond, and only those that may be the nearest are
// asked exactly, at the end: mostly one.
template <unsigned kKinds, class Query>
class Traversal {
public:
    // `ray`, which is the frame's, `frame` and `query` are kept by reference.
    HWY_INLINE Traversal(const flat::Scene& scene, const flat::Group& group, const BoxRay& ray, const RayFrame& frame,
                         std::uint64_t first_number, Query& query)
        : scene_(scene),
          group_(group),
          frame_(frame),
          box_ray_(ray),
          first_number_(first_number),
          query_(query),
          exact_(frame, group.extent),
          node_test_(ray),
          bound_(box_ray_.upper(query.limit())),
          possible_after_(below(box_ray_.t_min)),
          certain_after_(above(box_ray_.lower(larger(frame.ray.t_min, -kEndless)) + 2 * box_ray_.t_error)),
          certain_before_(below(box_ray_.upper(limn::smaller(query.limit(), kEndless)) - 2 * box_ray_.t_error)) {
        if constexpr (has_planar()) planar_.emplace(box_ray_, packed_error());
        if constexpr (has_spheres()) round_.emplace(box_ray_, packed_error());
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
            do {
                if (stack.size == 0) {
                    ask_pending();
                    return false;
                }
                --stack.size;
            } while (stack.near[stack.size] > bound_);
            next = stack.child[stack.size];
        }
    }

    // True if the query ended the search.
    bool run() {
        if (group_.root == flat::kNothing) return false;
        Stack stack;
        flat::Child next = group_.root;
        for (;;) {
            while (!(next & flat::kLeaf)) next = node_test_.visit(scene_, next, bound_, stack);
            if (next != flat::kNothing && leaf(next)) return true;
            do {
                if (stack.size == 0) return ask_pending();
                --stack.size;
            } while (stack.near[stack.size] > bound_);
            next = stack.child[stack.size];
        }
    }

private:
    static constexpr bool has(PrimitiveKind kind) { return (kKinds & flat::bit(kind)) != 0; }
    static constexpr bool has_planar() {
        return has(PrimitiveKind::mesh) || has(PrimitiveKind::triangle) || has(PrimitiveKind::quad);
    }
    static constexpr bool has_spheres() { return has(PrimitiveKind::sphere) || has(PrimitiveKind::moving_sphere); }
    // Where t may overflow, and a hit be none.
    static constexpr double kEndless = 1e300;
    float packed_error() const { return kKinds == flat::bit(PrimitiveKind::mesh) ? 0 : group_.packed_error; }

    // A hit for sure, not asked exactly yet.
    struct Pending {
        flat::BlockView block;
        std::uint32_t lane;
        float near;
    };
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

    HWY_INLINE bool test(const flat::BlockView& block, const flat::Block& header) {
        if constexpr (kKinds == flat::bit(PrimitiveKind::mesh)) {
            return take(test_planar<false>(block, header.count, *planar_, possible_after_, above(bound_)), block,
                        header);
        } else {
            switch (header.kind) {
                case PrimitiveKind::mesh:
                case PrimitiveKind::triangle:
                    if constexpr (has(PrimitiveKind::mesh) || has(PrimitiveKind::triangle))
                        return take(test_planar<false>(block, header.count, *planar_, possible_after_, above(bound_)),
                                    block, header);
                    break;
                case PrimitiveKind::quad:
                    if constexpr (has(PrimitiveKind::quad))
                        return take(test_planar<true>(block, header.count, *planar_, possible_after_, above(bound_)),
                                    block, header);
                    break;
                case PrimitiveKind::sphere:
                    if constexpr (has(PrimitiveKind::sphere))
                        return take(
                            test_spheres<false>(block, header.count, *round_, 0, possible_after_, above(bound_)), block,
                            header);
                    break;
                case PrimitiveKind::moving_sphere:
                    if constexpr (has(PrimitiveKind::moving_sphere))
                        return take(
                            test_spheres<true>(block, header.count, *round_, time(), possible_after_, above(bound_)),
                            block, header);
                    break;
                case PrimitiveKind::instance:
                case PrimitiveKind::foreign:
                    if constexpr (has(PrimitiveKind::instance) || has(PrimitiveKind::foreign))
                        return ask_boxes(block, header);
                    break;
                case PrimitiveKind::medium: break;  // never in a tree
            }
            return false;
        }
    }

    // As interpolate() clamps it.
    float time() const { return static_cast<float>(std::clamp(frame_.ray.time, 0.0, 1.0)); }

    HWY_INLINE bool take(const Candidates& found, const flat::BlockView& block, const flat::Block& header) {
        for (std::uint32_t open = found.open; open != 0; open &= open - 1) {
            const auto lane = static_cast<std::uint32_t>(std::countr_zero(open));
            const bool certain = (found.certain >> lane & 1) != 0 && found.near[lane] > certain_after_ &&
                                 found.far[lane] < certain_before_;
            if (certain && Query::kFirstHit) return query_.report({}, 0, false);
            if (certain && !Query::kEveryHit) {
                if (found.near[lane] > above(bound_)) continue;  // another lane's hit is nearer
                bound_ = smaller(bound_, above(found.far[lane] + box_ray_.t_error));
                postpone({block, lane, found.near[lane]});
            } else if (ask(block, header, lane)) {
                return true;
            }
        }
        return false;
    }

    // One by one, the nearest box first.
    bool ask_boxes(const flat::BlockView& block, const flat::Block& header) {
        const Candidates found = node_test_.test_boxes(block, header.count, bound_);
        for (std::uint32_t open = found.open; open != 0;) {
            auto next = static_cast<std::uint32_t>(std::countr_zero(open));
            for (std::uint32_t rest = open & (open - 1); rest != 0; rest &= rest - 1) {
                const auto other = static_cast<std::uint32_t>(std::countr_zero(rest));
                if (found.near[other] < found.near[next]) next = other;
            }
            if (found.near[next] > bound_) return false;
            if (ask(block, header, next)) return true;
            open &= ~(1u << next);
        }
        return false;
    }

    static float smaller(float a, float b) { return a < b ? a : b; }

    HWY_INLINE void postpone(const Pending& hit) {
        if (pending_count_ == kMaxPending) ask_pending();
        pending_[pending_count_++] = hit;
    }

    bool ask_pending() {
        for (std::size_t i = 0; i < pending_count_; ++i) {
            const Pending& hit = pending_[i];
            if (!(hit.near <= above(bound_))) continue;
            const flat::Block header = hit.block.header();
            if (!settle(hit.block, header, hit.lane) && ask(hit.block, header, hit.lane)) return true;
        }
        pending_count_ = 0;
        return false;
    }

    // Whether a sure hit could be answered at once.
    HWY_INLINE bool settle(const flat::BlockView& block, const flat::Block& header, std::uint32_t lane) {
        PlanarHit hit;
        std::uint64_t number = first_number_;
        Decision decision = Decision::undecided;
        if (has(PrimitiveKind::mesh) && header.kind == PrimitiveKind::mesh) {
            const TriangleVertices v = flat::packed_triangle(block, header.count, lane);
            decision = settle_one<false>(frame_, search(), v.a, v.b, v.c, hit);
            number += scene_.ranges[header.range].first_number + block.id(lane);
        } else if (has(PrimitiveKind::sphere) && header.kind == PrimitiveKind::sphere) {
            const flat::Reference& reference = scene_.references[block.id(lane)];
            const PrimitiveRange& range = scene_.ranges[reference.range];
            const flat::Sphere& s = scene_.spheres[range.first_row + reference.element];
            number += range.first_number + reference.element;
            decision = settle_one(frame_, search(), s.center, std::abs(s.radius), hit);
        } else if (has_planar() && (header.kind == PrimitiveKind::triangle || header.kind == PrimitiveKind::quad)) {
            const flat::Reference& reference = scene_.references[block.id(lane)];
            const PrimitiveRange& range = scene_.ranges[reference.range];
            number += range.first_number + reference.element;
            if (header.kind == PrimitiveKind::quad) {
                const flat::Quad& q = scene_.quads[range.first_row + reference.element];
                decision = settle_one<true>(frame_, search(), q.corner, q.edge_u, q.edge_v, hit);
            } else {
                const flat::Triangle& t = scene_.triangles[range.first_row + reference.element];
                decision = settle_one<false>(frame_, search(), t.a, t.b, t.c, hit);
            }
        }
        if (decision == Decision::hit) {
            query_.report(hit, number, false);
            bound_ = smaller(bound_, box_ray_.upper(query_.limit()));
        }
        return decision != Decision::undecided;
    }

    // Exactly.
    bool ask(const flat::BlockView& block, const flat::Block& header, std::uint32_t lane) {
        const std::uint32_t id = block.id(lane);
        bool end = false;
        if constexpr (has(PrimitiveKind::mesh)) {
            if (header.kind == PrimitiveKind::mesh) {
                const TriangleVertices v = flat::packed_triangle(block, header.count, lane);
                end = triangle(v.a, v.b, v.c, first_number_ + scene_.ranges[header.range].first_number + id);
                bound_ = smaller(bound_, box_ray_.upper(query_.limit()));
                return end;
            }
        }
        if constexpr (kKinds != flat::bit(PrimitiveKind::mesh)) {
            end = ask(scene_.references[id]);
            bound_ = smaller(bound_, box_ray_.upper(query_.limit()));
        }
        return end;
    }

    bool ask(const flat::Reference& reference) {
        const PrimitiveRange& range = scene_.ranges[reference.range];
        const std::uint64_t number = first_number_ + range.first_number + reference.element;
        const std::uint32_t row = range.first_row + reference.element;
        switch (range.kind) {
            case PrimitiveKind::sphere:
                if constexpr (has(PrimitiveKind::sphere)) {
                    const flat::Sphere& s = scene_.spheres[row];
                    return sphere(s.center, s.radius, number);
                }
                break;
            case PrimitiveKind::moving_sphere:
                if constexpr (has(PrimitiveKind::moving_sphere)) {
                    const flat::MovingSphere& s = scene_.moving_spheres[row];
                    return sphere(interpolate(s.center0, s.center1, frame_.ray.time), s.radius, number);
                }
                break;
            case PrimitiveKind::triangle:
                if constexpr (has(PrimitiveKind::triangle)) {
                    const flat::Triangle& t = scene_.triangles[row];
                    return triangle(t.a, t.b, t.c, number);
                }
                break;
            case PrimitiveKind::quad:
                if constexpr (has(PrimitiveKind::quad)) {
                    const flat::Quad& q = scene_.quads[row];
                    PlanarHit hit;
                    return exact_.quad(q.corner, q.edge_u, q.edge_v, search(), hit) &&
                           query_.report(hit, number, inward(cross(q.edge_u, q.edge_v)));
                }
                break;
            case PrimitiveKind::instance:
                if constexpr (has(PrimitiveKind::instance)) {
                    const flat::Instance& instance = scene_.instances[range.first_row];
                    if (ask_pending()) return true;  // so that the limit says all there is to say
                    return inside(instance, frame_, [&](const RayFrame& frame) {
                        return is_usable(frame.ray) &&
                               run_inside(flat::group_at(scene_, instance.group), frame, number);
                    });
                }
                break;
            case PrimitiveKind::foreign:
                if constexpr (has(PrimitiveKind::foreign)) {
                    if (ask_pending()) return true;
                    return foreign(scene_.foreign[row], number);
                }
                break;
            case PrimitiveKind::mesh:           // see above
            case PrimitiveKind::medium: break;  // never in a tree
        }
        return false;
    }

    bool run_inside(const flat::Group& group, const RayFrame& frame, std::uint64_t number) {
        BoxRay ray;
        set_up(frame.ray, frame, group, ray);
        return Traversal(scene_, group, ray, frame, number, query_).run();
    }

    bool inward(const Vec3& outward) const { return Query::kEveryHit && dot(outward, frame_.ray.direction) < 0; }

    Search search() const { return {frame_.ray.t_min, query_.limit()}; }

    bool sphere(const Point3& center, double radius, std::uint64_t number) {
        if constexpr (Query::kEveryHit) {
            const SphereHits hits = exact_.sphere(center, std::abs(radius), search(), true);
            return (hits.near_found && query_.report({hits.near, 0, 0}, number, radius > 0)) ||
                   (hits.far_found && query_.report({hits.far, 0, 0}, number, radius < 0));
        } else {
            const Ray& ray = frame_.ray;
            if (frame_.outer == nullptr && ray.t_min >= 0 && side_of(center, std::abs(radius), ray) == Side::missed)
                return false;
            PlanarHit hit{};
            return exact_.sphere(center, std::abs(radius), search(), hit.t) && query_.report(hit, number, false);
        }
    }

    bool triangle(const Point3& a, const Point3& b, const Point3& c, std::uint64_t number) {
        PlanarHit hit;
        return exact_.triangle(a, b, c, search(), hit) &&
               query_.report(hit, number, Query::kEveryHit && inward(cross(b - a, c - a)));
    }

    bool foreign(const flat::Foreign& shape, std::uint64_t number) {
        Ray rest = frame_.with_frame();  // it may consist of limn's own shapes
        rest.t_max = query_.limit();
        ForeignHit hit;
        while (shape.hit(*shape.object, rest, hit)) {
            if (!(hit.t > rest.t_min && hit.t <= rest.t_max)) return false;  // not what hit() promises: a miss
            const bool passes = Query::kThroughBoundaries && hit.index_matched;
            if (!passes && query_.report({hit.t, hit.u, hit.v}, number, inward(Vec3(hit.normal)), hit.index_matched))
                return true;
            if (!passes && !Query::kEveryHit) return false;
            rest.t_min = hit.t;
        }
        return false;
    }

    const flat::Scene& scene_;
    const flat::Group& group_;
    const RayFrame& frame_;
    const BoxRay& box_ray_;
    std::optional<PlanarRay> planar_;
    std::optional<RoundRay> round_;
    const std::uint64_t first_number_;
    Query& query_;
    ExactTests exact_;
    const NodeTest node_test_;
    float bound_;  // in BoxRay's t: no hit of interest is beyond
    // By t_min and t_max: hits before the first do not count, those that lie between the others do.
    const float possible_after_, certain_after_, certain_before_;
    std::size_t pending_count_ = 0;
    Pending pending_[kMaxPending];
};

}  // namespace limn::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
