// Rays of much the same way through one BLAS, a lane each. Per-target include guard, as Highway has it.
#if defined(LIMN_TRACE_PACKET_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_TRACE_PACKET_INL_H
#undef LIMN_TRACE_PACKET_INL_H
#else
#define LIMN_TRACE_PACKET_INL_H
#endif

#include "trace/deferred_hits-inl.h"
#include "trace/list-inl.h"
#include "trace/node-inl.h"
#include "trace/queries.h"

HWY_BEFORE_NAMESPACE();
namespace limn::trace::HWY_NAMESPACE {

// The boxes that any ray of the packet may meet, eight at once, from the ranges of origins and directions: a plane at p
// is met within (p - origin) * inverse, in intervals. What is outside is missed by all; the rest is left to the leaves.
class PacketBoxes {
public:
    // \pre the rays have the same octant, and are ordinary
    PacketBoxes(const BoxRay* rays, std::size_t count) : octant_(rays[0].octant) {
        const Lanes d;
        float t_min = rays[0].t_min;
        for (std::size_t a = 0; a < 3; ++a) {
            float low = rays[0].high[a], high = low, slow = rays[0].inverse[a], fast = slow, reach = 0;
            for (std::size_t i = 0; i < count; ++i) {
                low = std::min(low, rays[i].high[a]), high = std::max(high, rays[i].high[a]);
                slow = std::min(slow, rays[i].inverse[a]), fast = std::max(fast, rays[i].inverse[a]);
                reach = std::max(reach, rays[i].reach);
                t_min = std::min(t_min, rays[i].t_min);
            }
            const float wider = BoxRay::kWider * reach;
            const bool is_negative = (octant_ >> a & 1) != 0;
            near_from_[a] = hn::Set(d, is_negative ? low - wider : high + wider);
            far_from_[a] = hn::Set(d, is_negative ? high + wider : low - wider);
            slow_[a] = hn::Set(d, slow), fast_[a] = hn::Set(d, fast);
        }
        t_min_ = hn::Set(d, t_min);
    }

    // As NodeTest::visit. `t_max`: of the ray that goes farthest.
    HWY_INLINE flat::Child visit(const flat::Scene& scene, flat::Child at, float t_max, Stack& stack) const {
        const Lanes d;
        const flat::Node& node = scene.nodes[at];
        Eight eight;
        for (std::size_t i = 0; i < kVectors; ++i) {
            auto near = t_min_, far = hn::Set(d, t_max);
            for (std::size_t a = 0; a < 3; ++a) {
                const bool is_negative = (octant_ >> a & 1) != 0;
                const float* lower = node.planes[a] + i * hn::Lanes(d);
                const float* upper = node.planes[3 + a] + i * hn::Lanes(d);
                const auto to_near = hn::Sub(hn::Load(d, is_negative ? upper : lower), near_from_[a]);
                const auto to_far = hn::Sub(hn::Load(d, is_negative ? lower : upper), far_from_[a]);
                near = hn::Max(near, hn::Min(hn::Mul(to_near, slow_[a]), hn::Mul(to_near, fast_[a])));
                far = hn::Min(far, hn::Max(hn::Mul(to_far, slow_[a]), hn::Mul(to_far, fast_[a])));
            }
            eight.near[i] = near;
            eight.met[i] = hn::Le(near, far);
        }
        return choose(scene, node, octant_, eight, stack);
    }

private:
    V near_from_[3], far_from_[3], slow_[3], fast_[3], t_min_;
    unsigned octant_;
};

// Query: Closest or Any, one for each ray. Mesh triangles alone: what is large and met by bundles of rays.
template <class Query>
class PacketTraversal {
public:
    // All is kept by reference. \pre the rays are ordinary, of one octant and one longest axis; 0 < count <= kPacket
    PacketTraversal(const flat::Scene& scene, const flat::Blas& blas, const BoxRay* rays, const RayFrame* frames,
                    std::size_t count, Query* queries, DeferredHits* deferred)
        : scene_(scene),
          blas_(blas),
          rays_(rays),
          frames_(frames),
          queries_(queries),
          deferred_(deferred),
          count_(count) {
        for (std::size_t i = 0; i < kPacket; ++i) {
            const BoxRay& ray = rays[i < count ? i : 0];
            const PlanarRay planar(ray, 0);
            if (i == 0) std::copy_n(planar.axes, 3, axes_), leaves_ = true;
            for (std::size_t k = 0; k < kNumbers; ++k) numbers_[k][i] = number_of<float>(planar.numbers, k);
            leaves_ = leaves_ && planar.leaves;
            if (i >= count) {  // met by nothing
                bound_[i] = kNever, possible_after_[i] = 0;
                continue;
            }
            bound_[i] = ray.upper(queries[i].limit());
            possible_after_[i] = below(ray.t_min);
            certain_after_[i] = above(ray.t_min);
            certain_before_[i] = below(bound_[i]);
        }
    }

    void run() {
        if (blas_.root == flat::kNothing) return;
        const PacketBoxes boxes(rays_, count_);
        flat::Child next = blas_.root;
        float farthest = farthest_bound();
        for (;;) {
            while (!(next & flat::kLeaf)) next = boxes.visit(scene_, next, farthest, stack_);
            if (next != flat::kNothing && leaf(next)) farthest = farthest_bound();
            if (!stack_.pop(farthest, next)) return defer_pending();
        }
    }

private:
    static constexpr std::size_t kNumbers = PlanarFloatRay<float>::kNumbers;
    static constexpr float kNever = -std::numeric_limits<float>::max();

    struct Pending {
        flat::BlockView block;
        std::uint32_t lane;
        float near;
    };

    float farthest_bound() const { return max_of_lanes(load<RayFloats>(bound_)); }

    // Whether a bound has changed.
    bool leaf(flat::Child child) {
        flat::BlockView block{scene_.blocks.data() + std::size_t{2} * (child & ~flat::kLeaf)};
        bool changed = false;
        for (;;) {
            const flat::Block header = block.header();
            for (std::uint32_t i = 0; i < header.count; ++i) changed |= test(block, header, i);
            if (header.last) return changed;
            block.words += flat::words_of(header.kind, header.count);
        }
    }

    // A triangle for all lanes, a ray in each.
    HWY_INLINE bool test(const flat::BlockView& block, const flat::Block& header, std::uint32_t i) {
        const auto vertex = [&](std::size_t k) HWY_ATTR {
            const auto coordinate = [&](std::size_t a)
                                        HWY_ATTR { return RayFloats(block.number(header.count, 3 * k + axes_[a], i)); };
            return three<RayFloats>(coordinate, 0);
        };
        const auto ray =
            PlanarFloatRay<RayFloats>::from([&](std::size_t k) HWY_ATTR { return load<RayFloats>(numbers_[k]); });
        const auto hits = test_planar<false>(vertex, ray, first_lanes<RayFloats>(kPacket),
                                             first_lanes<RayFloats>(leaves_ ? kPacket : 0),
                                             {load<RayFloats>(possible_after_), above(load<RayFloats>(bound_))});
        if (!any(hits.possible)) return false;
        HWY_ALIGN float near[kPacket], far[kPacket];
        store(hits.near, near), store(hits.far, far);
        return take(block, i, bits(hits.possible), bits(hits.certain), near, far);
    }

    bool take(const flat::BlockView& block, std::uint32_t i, std::uint32_t possible, std::uint32_t certain,
              const float* near, const float* far) {
        bool changed = false;
        for (; possible != 0; possible &= possible - 1) {
            const auto r = static_cast<std::size_t>(std::countr_zero(possible));
            if (r >= count_ || near[r] > above(bound_[r])) continue;
            const bool is_certain =
                (certain >> r & 1) != 0 && near[r] > certain_after_[r] && far[r] < certain_before_[r];
            changed = true;
            if (is_certain && Query::kFirstHit) {
                queries_[r].report({}, 0, false);
                bound_[r] = kNever;
            } else if (is_certain) {
                const float bound = above(far[r]);
                if (bound < bound_[r]) bound_[r] = bound;
                Pending& pending = pending_[r];
                // Two that may be the nearest: the first is intersected at once.
                if (has_pending(r) && pending.near <= above(bound_[r]))
                    intersect_in_block(r, pending.block, pending.lane);
                pending = {block, i, near[r]};
                pending_mask_ |= 1u << r;
            } else {
                intersect_in_block(r, block, i);
            }
        }
        return changed;
    }

    bool has_pending(std::size_t r) const { return (pending_mask_ >> r & 1) != 0; }

    void defer_pending() {
        if constexpr (Query::kNearest)
            for (std::uint32_t rest = pending_mask_; rest != 0; rest &= rest - 1) {
                const auto r = static_cast<std::size_t>(std::countr_zero(rest));
                const Pending& hit = pending_[r];
                const flat::Block header = hit.block.header();
                if (hit.near <= above(bound_[r]))
                    deferred_->add(triangle(hit.block, header, hit.lane), frames_[r], queries_[r],
                                   number(hit.block, header, hit.lane));
            }
    }

    static TrianglePredicate<double> triangle(const flat::BlockView& block, const flat::Block& header,
                                              std::uint32_t i) {
        const TriangleVertices v = flat::packed_triangle(block, header.count, i);
        return triangle_of<double>(v.a, v.b, v.c);
    }
    std::uint64_t number(const flat::BlockView& block, const flat::Block& header, std::uint32_t i) const {
        return scene_.ranges[header.range].first_number + block.id(i);
    }

    // Exactly.
    void intersect_in_block(std::size_t r, const flat::BlockView& block, std::uint32_t i) {
        const flat::Block header = block.header();
        Query& query = queries_[r];
        PlanarHit hit;
        const Search search{frames_[r].ray.t_min, query.limit()};
        if (!intersect(triangle(block, header, i), frames_[r], search, hit)) return;
        const bool ended = query.report(hit, number(block, header, i), false);
        const float bound = ended ? kNever : rays_[r].upper(query.limit());
        if (bound < bound_[r]) bound_[r] = bound;
    }

    const flat::Scene& scene_;
    const flat::Blas& blas_;
    const BoxRay* rays_;
    const RayFrame* frames_;
    Query* queries_;
    DeferredHits* deferred_;
    std::size_t count_;
    unsigned axes_[3];
    bool leaves_ = false;  // all of them: nothing behind their origins counts
    HWY_ALIGN float numbers_[kNumbers][kPacket], bound_[kPacket], possible_after_[kPacket];
    float certain_after_[kPacket], certain_before_[kPacket];
    std::uint32_t pending_mask_ = 0;
    Pending pending_[kPacket];
    Stack::Rows rows_;
    Stack stack_{rows_};
};

}  // namespace limn::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
