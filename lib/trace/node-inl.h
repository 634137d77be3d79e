// Tests of a ray against the eight boxes of a node. The include guard is per target, as Highway requires.
#if defined(LIMN_TRACE_NODE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_TRACE_NODE_INL_H
#undef LIMN_TRACE_NODE_INL_H
#else
#define LIMN_TRACE_NODE_INL_H
#endif

#include <hwy/cache_control.h>

#include <bit>
#include <cstddef>

#include "flat/scene.h"
#include "math/compress-inl.h"
#include "trace/leaf-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::trace::HWY_NAMESPACE {

// The children that are still to be visited, with the t at which the ray enters their boxes.
struct Stack {
    struct Rows {
        flat::Child child[flat::kMaxStack];
        float near[flat::kMaxStack];
    };
    flat::Child* const child;
    float* const near;
    std::size_t size = 0;  // kept in a register, because no vector is written to this object

    explicit Stack(Rows& rows) : child(rows.child), near(rows.near) {}

    HWY_INLINE void push(flat::Child c, float t) {
        child[size] = c;
        near[size++] = t;
    }

    // Removes children up to and including the last one that is entered up to `bound`, and sets `next` to that. Returns
    // false if there is none.
    HWY_INLINE bool pop(float bound, flat::Child& next) {
        while (size != 0) {
            if (near[--size] > bound) continue;
            next = child[size];
            return true;
        }
        return false;
    }

#if HWY_MAX_BYTES >= 32
    // Pushes the lanes that `mask` selects, in their order.
    HWY_INLINE void push_some(V children, V t, M mask) {
        const Lanes d;
        const hn::RebindToUnsigned<Lanes> du;
        const Compress<Floats> compress({mask});
        hn::StoreU(hn::BitCast(du, compress(children).v), du, child + size);
        hn::StoreU(compress(t).v, d, near + size);
        size += static_cast<std::size_t>(std::popcount(bits(mask)));
    }
#endif
};

HWY_INLINE void prefetch(const flat::Scene& scene, flat::Child child) {
    const bool is_leaf = (child & flat::kLeaf) != 0;
    const void* const at =
        is_leaf ? static_cast<const void*>(&scene.lines[child & flat::kPlaceMask]) : &scene.nodes[child];
    const auto* const first = static_cast<const std::byte*>(at);
    for (std::size_t line = 0; line < 4; ++line) hwy::Prefetch(first + 64 * line);
}

// The planes of some boxes at which rays of an octant enter and leave them. `boxes` are rows of a node or block.
struct BoxPlanes {
    V near[3], far[3];

    HWY_INLINE BoxPlanes(const float* boxes, unsigned octant) {
        for (std::size_t a = 0; a < 3; ++a) {
            const std::size_t negative = octant >> a & 1;
            near[a] = hn::LoadU(Lanes(), boxes + flat::kWidth * (a + 3 * negative));
            far[a] = hn::LoadU(Lanes(), boxes + flat::kWidth * (a + 3 - 3 * negative));
        }
    }
};
// A ray in all lanes. Boxes that it enters after `bound` are missed.
struct BoxRay {
    V inverse[3], near_shift[3], far_shift[3], t_min, bound;

    HWY_INLINE BoxRay(const WalkRay& ray, float t_max)
        : t_min(hn::Set(Lanes(), ray.t_min)), bound(hn::Set(Lanes(), t_max)) {
        for (std::size_t a = 0; a < 3; ++a) {
            inverse[a] = hn::Set(Lanes(), ray.inverse[a]);
            near_shift[a] = hn::Set(Lanes(), ray.near_shift[a]);
            far_shift[a] = hn::Set(Lanes(), ray.far_shift[a]);
        }
    }
};
// The result of a test of boxes.
struct BoxHits {
    V near;  // t at which the ray enters each box
    M missed;
};

// Tests a ray against boxes.
//
// If kOrdinary, t are compared as integers, by their bits. Minima and maxima of integers take one cycle, those of
// floats four. \pre t_min and the bound are at least +0
//   - Floats from +0 up are ordered as their bits are, and negative floats have negative bits. As t_min >= +0, the
//     largest of t_min and the t of near planes is right.
//   - The smallest of the bound and the t of far planes is right if none is negative. If one is negative or -0, the
//     result is negative, and the box is missed. It holds no hit at t > t_min >= 0, because the t of far planes is
//     larger than that of each hit (WalkRay).
//   - The near planes of an absent box are met at +infinity, and its far planes at -infinity, so it is missed.
//   - No t is a NaN, because the inverse is finite and not 0 and the shifts are finite.
template <bool kOrdinary>
HWY_INLINE BoxHits test_boxes(const BoxPlanes& planes, const BoxRay& ray) {
    using Order = Wide<std::conditional_t<kOrdinary, hn::RebindToSigned<Lanes>, Lanes>>;
    const auto ordered = [](V t) HWY_ATTR { return Order(hn::BitCast(typename Order::Tag(), t)); };
    const auto near = [&](std::size_t a)
                          HWY_ATTR { return ordered(hn::MulAdd(planes.near[a], ray.inverse[a], ray.near_shift[a])); };
    const auto far = [&](std::size_t a)
                         HWY_ATTR { return ordered(hn::MulAdd(planes.far[a], ray.inverse[a], ray.far_shift[a])); };
    const Order enter = max(max(near(0), near(1)), max(near(2), ordered(ray.t_min)));
    const Order leave = min(min(far(0), far(1)), min(far(2), ordered(ray.bound)));
    return {hn::BitCast(Lanes(), enter.v), hn::RebindMask(Lanes(), (leave < enter).m)};
}

// The number of vectors that hold eight boxes.
inline constexpr std::size_t kVectors = flat::kWidth / hn::MaxLanes(Lanes());

// The result of a test of eight boxes.
struct Eight {
    BoxHits hits[kVectors];
    std::uint32_t met = 0;  // bit i: the ray enters box i up to the bound

    // Tests a ray. `boxes` are the rows of a node or block.
    template <bool kOrdinary>
    HWY_INLINE static Eight test(const float* boxes, unsigned octant, const BoxRay& ray) {
        Eight eight;
        for (std::size_t i = 0; i < kVectors; ++i) {
            eight.hits[i] = test_boxes<kOrdinary>(BoxPlanes(boxes + i * kLanes<Floats>, octant), ray);
            eight.met |= (bits(eight.hits[i].missed) ^ ((1u << kLanes<Floats>)-1)) << (i * kLanes<Floats>);
        }
        return eight;
    }
    HWY_INLINE void store_near(float* to) const {
        for (std::size_t i = 0; i < kVectors; ++i) hn::Store(hits[i].near, Lanes(), to + i * kLanes<Floats>);
    }
};

// Returns one of the children that are met, and pushes the others. If kSorts, it returns the nearest and pushes the
// farthest first. Otherwise it returns the last and pushes the others in their order, as if they were entered before
// any t. \pre eight.met is not 0
template <bool kSorts>
HWY_INLINE flat::Child choose(const flat::Scene& scene, const flat::Node& node, unsigned octant, const Eight& eight,
                              Stack& stack) {
    const auto first = static_cast<std::size_t>(std::countr_zero(eight.met));
    const std::uint32_t others = eight.met & (eight.met - 1);
    if (others == 0) return node.child[first];
    constexpr float kAnywhere = -std::numeric_limits<float>::infinity();
    HWY_ALIGN float near[flat::kWidth];
    if ((others & (others - 1)) == 0) {
        // Only one child is more common than two. A branch may be predicted; then nothing waits for the comparison.
        const auto second = static_cast<std::size_t>(std::countr_zero(others));
        if constexpr (kSorts) eight.store_near(near);
        const bool is_first = kSorts && near[first] <= near[second];
        const flat::Child later = node.child[is_first ? second : first];
        prefetch(scene, later);
        stack.push(later, kSorts ? near[is_first ? second : first] : kAnywhere);
        return node.child[is_first ? first : second];
    }
#if HWY_MAX_BYTES >= 32
    // Push all that are met, and take the last back.
    const Lanes d;
    const hn::RebindToUnsigned<Lanes> du;
    const auto children = hn::BitCast(d, hn::LoadU(du, node.child));
    if constexpr (!kSorts) {
        stack.push_some(children, hn::Set(d, kAnywhere), hn::Not(eight.hits[0].missed));
        return stack.child[--stack.size];
    }
#endif
    const std::uint32_t order = node.order[octant];
#if HWY_MAX_BYTES >= 32
    const auto slots = hn::And(hn::Shr(hn::Set(du, order), hn::ShiftLeft<2>(hn::Iota(du, 0))), hn::Set(du, 7));
    const auto sorted = hn::IndicesFromVec(d, hn::BitCast(hn::RebindToSigned<Lanes>(), slots));
    const auto infinity = hn::Set(d, std::numeric_limits<float>::infinity());
    const auto near_sorted =
        hn::TableLookupLanes(hn::IfThenElse(eight.hits[0].missed, infinity, eight.hits[0].near), sorted);
    stack.push_some(hn::TableLookupLanes(children, sorted), near_sorted, hn::Lt(near_sorted, infinity));
#else
    eight.store_near(near);
    for (std::uint32_t slots = order, k = 0; k < flat::kWidth; ++k, slots >>= 4) {
        const std::uint32_t i = slots & 7;
        if ((eight.met >> i & 1) != 0) stack.push(node.child[i], near[i]);
    }
#endif
    return stack.child[--stack.size];
}

// Returns the next leaf that the ray may hit up to `bound`. It is below the node `next`, or else on the stack or below
// it. Returns kNothing if there is none.
template <bool kOrdinary, bool kSorts>
HWY_INLINE flat::Child next_leaf(const flat::Scene& scene, const WalkRay& ray, flat::Child next, float bound,
                                 Stack& stack) {
    const BoxRay box_ray(ray, bound);
    const unsigned octant = ray.octant;
    do {
        const flat::Node& node = scene.nodes[next];
        const Eight eight = Eight::test<kOrdinary>(node.planes[0], octant, box_ray);
        if (HWY_LIKELY(eight.met != 0))
            next = choose<kSorts>(scene, node, octant, eight, stack);
        else if (!stack.pop(bound, next))
            return flat::kNothing;
    } while (!(next & flat::kLeaf));
    return next;
}

}  // namespace limn::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
