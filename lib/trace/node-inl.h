// A ray against the eight boxes of a node. Per-target include guard, as Highway has it.
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
#include "geometry/bvh/wide_bvh.h"
#include "math/compress-inl.h"
#include "trace/box_ray.h"
#include "trace/leaf-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::trace::HWY_NAMESPACE {

// Children yet to be visited, and where the ray enters their boxes. A visit pushes at most 7 of 8, a whole vector is
// written.
struct Stack {
    static constexpr std::size_t kSize = accel::kMaxWideDepth * (flat::kWidth - 1) + flat::kWidth;
    struct Rows {
        flat::Child child[kSize];
        float near[kSize];
    };
    flat::Child* const child;
    float* const near;
    std::size_t size = 0;  // apart from what vectors are written to: in a register

    explicit Stack(Rows& rows) : child(rows.child), near(rows.near) {}

    HWY_INLINE void push(flat::Child c, float t) {
        child[size] = c;
        near[size++] = t;
    }

    // The last one that is entered up to `bound`. False where there is none.
    HWY_INLINE bool pop(float bound, flat::Child& next) {
        while (size != 0) {
            if (near[--size] > bound) continue;
            next = child[size];
            return true;
        }
        return false;
    }

#if HWY_MAX_BYTES >= 32
    // Those of eight lanes whose mask is set, in their order.
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

// Where a ray enters the boxes of eight children, and which it meets: as many vectors as that takes.
inline constexpr std::size_t kVectors = flat::kWidth / hn::MaxLanes(Lanes());
struct Eight {
    V near[kVectors];
    M met[kVectors];
};

HWY_INLINE void prefetch(const flat::Scene& scene, flat::Child child) {
    const bool is_leaf = (child & flat::kLeaf) != 0;
    const void* const at = is_leaf ? static_cast<const void*>(scene.blocks.data()) : scene.nodes.data();
    const std::size_t offset = is_leaf ? std::size_t{8} * (child & ~flat::kLeaf) : sizeof(flat::Node) * child;
    const auto* const first = static_cast<const std::byte*>(at) + offset;
    for (std::size_t line = 0; line < 4; ++line) hwy::Prefetch(first + 64 * line);
}

// The nearest child that is met, or kNothing; the others go onto the stack, the farthest first.
HWY_INLINE flat::Child choose(const flat::Scene& scene, const flat::Node& node, unsigned octant, const Eight& eight,
                              Stack& stack) {
    const Lanes d;
    std::uint32_t mask = 0;
    for (std::size_t i = 0; i < kVectors; ++i) mask |= bits(eight.met[i]) << (i * hn::Lanes(d));
    if (mask == 0) return flat::kNothing;
    const auto first = static_cast<std::size_t>(std::countr_zero(mask));
    const std::uint32_t others = mask & (mask - 1);
    if (others == 0) return node.child[first];
    HWY_ALIGN float near[flat::kWidth];
    if ((others & (others - 1)) == 0) {
        // The most common case but one. A branch can be predicted, and then nothing waits for the comparison.
        for (std::size_t i = 0; i < kVectors; ++i) hn::Store(eight.near[i], d, near + i * hn::Lanes(d));
        const auto second = static_cast<std::size_t>(std::countr_zero(others));
        const bool is_first = near[first] <= near[second];
        const flat::Child later = node.child[is_first ? second : first];
        prefetch(scene, later);
        stack.push(later, near[is_first ? second : first]);
        return node.child[is_first ? first : second];
    }
    const std::uint32_t order = node.order[octant];
#if HWY_MAX_BYTES >= 32
    const hn::RebindToUnsigned<Lanes> du;
    const auto slots = hn::And(hn::Shr(hn::Set(du, order), hn::ShiftLeft<2>(hn::Iota(du, 0))), hn::Set(du, 7));
    const auto sorted = hn::IndicesFromVec(d, hn::BitCast(hn::RebindToSigned<Lanes>(), slots));
    const auto infinity = hn::Set(d, std::numeric_limits<float>::infinity());
    const auto near_sorted = hn::TableLookupLanes(hn::IfThenElse(eight.met[0], eight.near[0], infinity), sorted);
    const auto children = hn::TableLookupLanes(hn::BitCast(d, hn::LoadU(du, node.child)), sorted);
    stack.push_some(children, near_sorted, hn::Lt(near_sorted, infinity));
#else
    for (std::size_t i = 0; i < kVectors; ++i) hn::Store(eight.near[i], d, near + i * hn::Lanes(d));
    for (std::uint32_t slots = order, k = 0; k < flat::kWidth; ++k, slots >>= 4) {
        const std::uint32_t i = slots & 7;
        if ((mask >> i & 1) != 0) stack.push(node.child[i], near[i]);
    }
#endif
    return stack.child[--stack.size];
}

// BoxRay in vectors.
struct NodeTest {
    V inverse[3], near_shift[3], far_shift[3], t_min;
    std::size_t near_plane[3], far_plane[3];  // of the six of a box
    unsigned octant;

    explicit NodeTest(const BoxRay& ray) : t_min(hn::Set(Lanes(), ray.t_min)), octant(ray.octant) {
        for (std::size_t a = 0; a < 3; ++a) {
            inverse[a] = hn::Set(Lanes(), ray.inverse[a]);
            near_shift[a] = hn::Set(Lanes(), ray.near_shift[a]);
            far_shift[a] = hn::Set(Lanes(), ray.far_shift[a]);
            const bool negative = (ray.octant >> a & 1) != 0;
            near_plane[a] = a + (negative ? 3 : 0);
            far_plane[a] = a + (negative ? 0 : 3);
        }
    }

    // plane(p): that of the six, of several boxes.
    template <class Plane>
    HWY_INLINE V enter(const Plane& plane) const {
        const auto x = hn::MulAdd(plane(near_plane[0]), inverse[0], near_shift[0]);
        const auto y = hn::MulAdd(plane(near_plane[1]), inverse[1], near_shift[1]);
        const auto z = hn::MulAdd(plane(near_plane[2]), inverse[2], near_shift[2]);
        return hn::Max(hn::Max(x, y), hn::Max(z, t_min));
    }
    template <class Plane>
    HWY_INLINE V leave(const Plane& plane, V t_max) const {
        const auto x = hn::MulAdd(plane(far_plane[0]), inverse[0], far_shift[0]);
        const auto y = hn::MulAdd(plane(far_plane[1]), inverse[1], far_shift[1]);
        const auto z = hn::MulAdd(plane(far_plane[2]), inverse[2], far_shift[2]);
        return hn::Min(hn::Min(x, y), hn::Min(z, t_max));
    }

    // Which of the boxes in a block are met, and where.
    HWY_INLINE Candidates test_boxes(const flat::BlockView& block, std::size_t count, float t_max) const {
        const Lanes d;
        const std::uint32_t* const rows = block.rows(count);
        Candidates found;
        for (std::size_t i = 0; has_vector(i, count); i += hn::Lanes(d)) {
            const auto plane = [&](std::size_t p) HWY_ATTR { return load_floats(rows + p * count + i); };
            const auto near = enter(plane), far = leave(plane, hn::Set(d, t_max));
            found.add({{hn::And(hn::Le(near, far), hn::FirstN(d, count - i))}, {hn::FirstN(d, 0)}, near, far}, i);
        }
        return found;
    }

    // The nearest child that the ray meets before t_max, or kNothing; the others go onto the stack, the farthest first.
    HWY_INLINE flat::Child visit(const flat::Scene& scene, flat::Child at, float t_max, Stack& stack) const {
        const Lanes d;
        const flat::Node& node = scene.nodes[at];
        Eight eight;
        for (std::size_t i = 0; i < kVectors; ++i) {
            const auto plane = [&](std::size_t p) HWY_ATTR { return hn::Load(d, node.planes[p] + i * hn::Lanes(d)); };
            eight.near[i] = enter(plane);
            eight.met[i] = hn::Le(eight.near[i], leave(plane, hn::Set(d, t_max)));
        }
        return choose(scene, node, octant, eight, stack);
    }
};

}  // namespace limn::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
