// Searches one BLAS with one ray. The include guard is per target, as Highway requires.
#if defined(LIMN_TRACE_TRAVERSAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_TRACE_TRAVERSAL_INL_H
#undef LIMN_TRACE_TRAVERSAL_INL_H
#else
#define LIMN_TRACE_TRAVERSAL_INL_H
#endif

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "geometry/sphere_side.h"
#include "trace/node-inl.h"
#include "trace/queries.h"
#include "trace/report-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::trace::HWY_NAMESPACE {

template <unsigned kKinds, bool kInWorld, class Query>
bool search_blas(const flat::Scene& scene, const flat::Blas& blas, const Ray& ray, const RayFrame& frame,
                 std::uint64_t first_number, Query& query);

// The search of a BLAS. Code is omitted for primitives of kinds outside the set kKinds. If kOrdinary, the ray was made
// by set_up() in walk_ray-inl.h; otherwise it is an AdaptedRay.
//
// Boxes and packed primitives are tested in float. A primitive for which such a test is undecided is intersected
// exactly at once. A sure hit is kept, and `bound_` is lowered to the upper bound on its t. At the end the sure hits
// that may be the nearest are intersected exactly; mostly that is one.
template <bool kOrdinary, unsigned kKinds, class Query>
class Traversal {
public:
    using RayHere = std::conditional_t<kOrdinary, WalkRay, AdaptedRay>;
    // True if children are visited from near to far. A search for any hit visits the largest child first, unless there
    // are user-defined shapes, which may take long.
    static constexpr bool kSorts = !Query::kFirstHit || (kKinds & flat::bit(PrimitiveKind::user_defined)) != 0;

    // The arguments but first_number, the number of the first primitive of the BLAS, must outlive this object. If
    // `instance` is null, `frame` is that of the ray. Otherwise the BLAS is that of the instance, and `frame` is that
    // of the ray outside it: the frame inside is made only for exact tests.
    HWY_INLINE Traversal(const flat::Scene& scene, const flat::Blas& blas, const RayHere& ray, const RayFrame& frame,
                         const flat::Instance* instance, std::uint64_t first_number, Query& query)
        : scene_(scene),
          blas_(blas),
          frame_(frame),
          instance_(instance),
          ray_(ray),
          first_number_(first_number),
          query_(query) {
        bound_ = upper(query.limit());
        possible_after_ = lowered(ray.t_min);
        if constexpr (kOrdinary) {
            certain_after_ = raised(ray.t_min);
            certain_before_ = lowered(bound_);
        } else {
            certain_after_ = above(ray.lower(larger(frame.ray.t_min, -kEndless)) + 2 * ray.t_error);
            certain_before_ = below(ray.upper(smaller(query.limit(), kEndless)) - 2 * ray.t_error);
        }
    }

    // Searches the BLAS. Returns true if the query ended the search.
    bool run() {
        if (blas_.root == flat::kNothing) return false;
        const bool ended = run_from(blas_.root);
        if (!ended) finish();
        return ended;
    }

    // These three make up a search: below a child, in a leaf, and the end of the search. The first two return true if
    // the query ended the search.
    HWY_INLINE bool run_from(flat::Child next) {
        Stack::Rows rows;
        Stack stack(rows);
        do {
            if (!(next & flat::kLeaf)) next = next_leaf<kOrdinary, kSorts>(scene_, ray_, next, bound_, stack);
            if (next == flat::kNothing) return false;
            if (leaf(next)) return true;
        } while (stack.pop(bound_, next));
        return false;
    }
    HWY_INLINE bool leaf(flat::Child leaf) {
        // Compare the form only with those that the scene may have.
        using flat::Form;
        constexpr unsigned kForms = flat::forms_of(kKinds);
        const auto is = [&](Form form) HWY_ATTR {
            const unsigned bit = 1u << static_cast<unsigned>(form);
            return kForms == bit || ((kForms & bit) != 0 && flat::form_of(leaf) == form);
        };
        // Test the block.
        const flat::BlockView block(&scene_.lines[leaf & flat::kPlaceMask]);
        const float limit = raised(bound_);
        if (is(Form::triangles)) return take(test_planar<false>(block, ray_, possible_after_, limit), leaf);
        if (is(Form::quads)) return take(test_planar<true>(block, ray_, possible_after_, limit), leaf);
        if (is(Form::spheres))
            return take(test_spheres<false>(block, ray_, 0, possible_after_, certain_after_, limit), leaf);
        if (is(Form::moving_spheres))
            return take(test_spheres<true>(block, ray_, time(), possible_after_, certain_after_, limit), leaf);
        return is(Form::boxes) && intersect_boxes(leaf);
    }
    HWY_INLINE void finish() {
        if constexpr (Query::kNearest) intersect_pending();
    }

    // Returns a t beyond which no hit is of interest.
    float bound() const { return bound_; }

private:
    static constexpr bool has(PrimitiveKind kind) { return (kKinds & flat::bit(kind)) != 0; }
    // A hit at a larger t may be none, because its t may overflow.
    static constexpr double kEndless = 1e300;

    // Of n hits in random order, ln n + 0.6 on average are nearer than all before them: 8 of 1,700. If the array is
    // full, its hits are intersected earlier.
    static constexpr std::size_t kMaxPending = 8;

    // Returns the t of ray_, rounded to float.
    HWY_INLINE float upper(double t) const {
        if constexpr (kOrdinary)
            return t < 0x1p120 ? static_cast<float>(t) : std::numeric_limits<float>::infinity();
        else
            return ray_.upper(t);
    }
    // These return above(t) and below(t). The t of an ordinary ray are not negative.
    static HWY_INLINE float raised(float t) { return kOrdinary ? t * (1 + 0x1p-22f) : above(t); }
    static HWY_INLINE float lowered(float t) { return kOrdinary ? t * (1 - 0x1p-22f) : below(t); }

    // Returns the time, clamped as interpolate() does.
    float time() const { return static_cast<float>(std::clamp(frame_.ray.time, 0.0, 1.0)); }

    // Takes the result of the test of a leaf. Returns true if the query ended the search.
    HWY_INLINE bool take(const Candidates& found, flat::Child leaf) {
        for (std::uint32_t possible = found.possible; possible != 0; possible &= possible - 1) {
            const auto lane = static_cast<std::uint32_t>(std::countr_zero(possible));
            const bool certain = (found.certain >> lane & 1) != 0 && found.near[lane] > certain_after_ &&
                                 found.far[lane] < certain_before_;
            if (certain && Query::kFirstHit) return query_.report({}, 0, false);
            if (certain && Query::kNearest) {
                if (found.near[lane] > raised(bound_)) continue;  // another lane's hit is nearer
                bound_ = std::min(bound_, raised(found.far[lane] + ray_.t_error));
                postpone({leaf, lane, found.near[lane], found.far[lane]});
            } else if (intersect_in_block(leaf, lane)) {
                return true;
            }
        }
        return false;
    }

    // Intersects the primitives of a leaf whose boxes are met, the nearest box first. Returns true if the query ended
    // the search.
    bool intersect_boxes(flat::Child leaf) {
        const flat::BlockView block(&scene_.lines[leaf & flat::kPlaceMask]);
        const Eight eight = Eight::test<kOrdinary>(block.rows, ray_.octant, BoxRay(ray_, bound_));
        std::uint32_t met = eight.met & ((2u << (block.count(flat::Form::boxes) - 1)) - 1);
        if (met == 0) return false;
        HWY_ALIGN float near[flat::kWidth];
        eight.store_near(near);
        while (met != 0) {
            auto next = static_cast<std::uint32_t>(std::countr_zero(met));
            for (std::uint32_t rest = met & (met - 1); rest != 0; rest &= rest - 1) {
                const auto other = static_cast<std::uint32_t>(std::countr_zero(rest));
                if (near[other] < near[next]) next = other;
            }
            if (near[next] > bound_) return false;
            if (intersect_in_block(leaf, next)) return true;
            met &= ~(1u << next);
        }
        return false;
    }

    HWY_INLINE void postpone(const SureHit& hit) {
        if (pending_count_ == kMaxPending) intersect_pending();
        pending_[pending_count_++] = hit;
    }

    // Lowers the query's limit to what `bound_` knows from pending hits. The search of an instance and a user-defined
    // shape need it.
    void update_limit() {
        if constexpr (Query::kNearest && kOrdinary) query_.lower_limit(double{raised(bound_)});
        if constexpr (Query::kNearest && !kOrdinary) intersect_pending();
    }

    void intersect_pending() {
        for (std::size_t i = 0; i < pending_count_; ++i) {
            const SureHit& hit = pending_[i];
            if (hit.near <= raised(bound_) && !report_sure(hit)) intersect_in_block(hit.leaf, hit.lane);
        }
        pending_count_ = 0;
    }

    // Reports a sure hit of a ray in world space without an exact test. Returns false if that isn't possible.
    HWY_INLINE bool report_sure([[maybe_unused]] const SureHit& hit) {
#if HWY_MAX_BYTES >= 32
        if constexpr (kOrdinary && Query::kNearest) {
            if (frame_.outer != nullptr || instance_ != nullptr) return false;
            const flat::BlockView block(&scene_.lines[hit.leaf & flat::kPlaceMask]);
            const std::uint32_t id = block.id(flat::form_of(hit.leaf), hit.lane);
            std::uint64_t number = first_number_ + id;
            PlanarHit found;
            if ((id & flat::kReference) == 0) {
                if (!locate_sure_hit(block, hit, ray_, frame_.ray, found)) return false;
            } else {
                const flat::Reference& reference = scene_.references[id & ~flat::kReference];
                const PrimitiveRange& range = scene_.ranges[reference.range];
                number = first_number_ + range.first_number + reference.element;
                const auto locate = [&](const SpherePredicate<double>& sphere)
                                        HWY_ATTR { return locate_sure_hit(sphere, hit, frame_.ray, found); };
                if (!with_shape<kKinds & flat::kRoundKinds>(scene_, range.kind, range.first_row + reference.element, 0,
                                                            frame_.ray.time, locate))
                    return false;
            }
            if (found.t <= query_.limit()) query_.report(found, number, false);
            bound_ = std::min(bound_, upper(query_.limit()));
            return true;
        }
#endif
        return false;
    }

    // Intersects a primitive of a leaf exactly. Returns true if the query ended the search.
    bool intersect_in_block(flat::Child leaf, std::uint32_t lane) {
        const flat::BlockView block(&scene_.lines[leaf & flat::kPlaceMask]);
        const std::uint32_t id = block.id(flat::form_of(leaf), lane);
        bool end = false;
        if ((id & flat::kReference) != 0) {
            end = intersect_reference(scene_.references[id & ~flat::kReference]);
        } else if constexpr (has(PrimitiveKind::mesh)) {
            const TriangleVertices v = block.triangle(lane);
            if (starts_at_corner(v)) return false;
            end = intersect_shape(triangle_of<double>(v.a, v.b, v.c), first_number_ + id);
        }
        bound_ = std::min(bound_, upper(query_.limit()));
        return end;
    }

    // Returns true if the origin is exactly a corner of the triangle and t_min is not negative. Then the ray misses: it
    // either meets the triangle's plane at t = 0 or is in that plane.
    bool starts_at_corner(const TriangleVertices& v) const {
        const Ray& ray = frame_.ray;
        const bool is_in_world = frame_.outer == nullptr && instance_ == nullptr;
        return is_in_world && !Query::kMoved && ray.t_min >= 0 &&
               (v.a == ray.origin || v.b == ray.origin || v.c == ray.origin);
    }

    bool intersect_reference(const flat::Reference& reference) {
        const PrimitiveRange& range = scene_.ranges[reference.range];
        const std::uint64_t number = first_number_ + range.first_number + reference.element;
        if constexpr (has(PrimitiveKind::instance)) {
            if (range.kind == PrimitiveKind::instance) {
                update_limit();
                return search_instance(scene_.instances[range.first_row], number);
            }
        }
        const bool is_mesh = range.kind == PrimitiveKind::mesh;
        const std::uint32_t row = range.first_row + (is_mesh ? 0 : reference.element);
        if constexpr (has(PrimitiveKind::user_defined)) {
            if (range.kind == PrimitiveKind::user_defined) {
                update_limit();
                return intersect_user_defined(scene_.user_defined[row], number);
            }
        }
        return with_shape<kKinds>(scene_, range.kind, row, reference.element, frame_.ray.time,
                                  [&](const auto& shape) { return intersect_shape(shape, number); });
    }

    template <class Shape>
    HWY_NOINLINE bool intersect_shape(const Shape& shape, std::uint64_t number) {
        return with_frame([&](const RayFrame& frame) { return report_hits(shape, frame, number, query_); });
    }
    HWY_NOINLINE bool intersect_shape(const SpherePredicate<double>& sphere, std::uint64_t number) {
        return with_frame([&](const RayFrame& frame) {
            if constexpr (!Query::kEveryHit) {
                const Point3 center{sphere.center.x, sphere.center.y, sphere.center.z};
                if (frame.outer == nullptr && frame.ray.t_min >= 0 &&
                    side_of(center, std::abs(sphere.radius), frame.ray) == Side::missed)
                    return false;
            }
            return report_hits(sphere, frame, number, query_);
        });
    }

    HWY_NOINLINE bool search_instance(const flat::Instance& instance, std::uint64_t number) {
        const flat::Blas& blas = flat::blas_at(scene_, instance.blas);
#if HWY_MAX_BYTES >= 32
        if (kOrdinary && frame_.outer == nullptr && instance_ == nullptr) {
            WalkRay ray;
            if (HWY_LIKELY(set_up<kKinds>(ray_in_instance(frame_.ray, instance), frame_.ray, blas, kFarInside, ray)))
                return Traversal<true, kKinds, Query>(scene_, blas, ray, frame_, &instance, number, query_).run();
        }
#endif
        return with_frame([&](const RayFrame& outside) {
            return inside(instance, outside, [&](const RayFrame& frame) {
                return search_blas<kKinds, false>(scene_, blas, frame.ray, frame, number, query_);
            });
        });
    }

    template <class Visit>
    HWY_INLINE bool with_frame(const Visit& visit) {
        return instance_ == nullptr ? visit(frame_) : inside(*instance_, frame_, visit);
    }

    bool intersect_user_defined(const flat::UserDefined& shape, std::uint64_t number) {
        return with_frame([&](const RayFrame& frame) {
            Ray rest = frame.with_frame();  // the shape may consist of limn's own shapes
            rest.t_max = query_.limit();
            UserDefinedHit hit;
            while (shape.hit(*shape.object, rest, hit)) {
                if (!(hit.t > rest.t_min && hit.t <= rest.t_max)) return false;  // hit() is wrong: a miss
                const bool passes = query_.passes(hit);
                const bool inward = Query::kEveryHit && dot(Vec3(hit.normal), frame.ray.direction) < 0;
                if (!passes && query_.report({hit.t, hit.u, hit.v}, number, inward, hit.index_matched)) return true;
                if (!passes && !Query::kEveryHit) return false;
                rest.t_min = hit.t;
            }
            return false;
        });
    }

    const flat::Scene& scene_;
    const flat::Blas& blas_;
    const RayFrame& frame_;
    const flat::Instance* const instance_;
    const RayHere& ray_;
    const std::uint64_t first_number_;
    Query& query_;
    float bound_;  // no hit beyond this t is of interest
    // Hits before possible_after_ are outside the search. Hits between the other two are surely inside.
    float possible_after_, certain_after_, certain_before_;
    std::size_t pending_count_ = 0;
    SureHit pending_[kMaxPending];
};

}  // namespace limn::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
