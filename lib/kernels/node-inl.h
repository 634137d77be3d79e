// A ray against the eight boxes of a node. Per-target include guard, as Highway has it.
#if defined(LIMN_KERNELS_NODE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_KERNELS_NODE_INL_H
#undef LIMN_KERNELS_NODE_INL_H
#else
#define LIMN_KERNELS_NODE_INL_H
#endif

#include <bit>

#include "accel/wide_bvh.h"
#include "kernels/box_ray.h"
#include "kernels/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::kernels::HWY_NAMESPACE {

// Children yet to be visited, and where the ray enters their boxes. A visit pushes at most 7 of 8, a whole vector is
// written.
struct Stack {
    static constexpr std::size_t kSize = accel::kMaxWideDepth * (flat::kWidth - 1) + flat::kWidth;
    std::size_t size = 0;
    flat::Child child[kSize];
    float near[kSize];
};

// BoxRay in vectors.
struct NodeTest {
    V inverse[3], near_shift[3], far_shift[3], t_min;
    std::size_t near_row[3], far_row[3];  // of Node::lower and upper, as one array of rows
    unsigned octant;

    explicit NodeTest(const BoxRay& ray) : t_min(hn::Set(Lanes(), ray.t_min)), octant(ray.octant) {
        for (std::size_t a = 0; a < 3; ++a) {
            inverse[a] = hn::Set(Lanes(), ray.inverse[a]);
            near_shift[a] = hn::Set(Lanes(), ray.near_shift[a]);
            far_shift[a] = hn::Set(Lanes(), ray.far_shift[a]);
            const bool negative = (ray.octant >> a & 1) != 0;
            near_row[a] = (a + (negative ? 3 : 0)) * flat::kWidth;
            far_row[a] = (a + (negative ? 0 : 3)) * flat::kWidth;
        }
    }

    HWY_INLINE V enter(const float* planes) const {
        const Lanes d;
        const auto x = hn::MulAdd(hn::LoadU(d, planes + near_row[0]), inverse[0], near_shift[0]);
        const auto y = hn::MulAdd(hn::LoadU(d, planes + near_row[1]), inverse[1], near_shift[1]);
        const auto z = hn::MulAdd(hn::LoadU(d, planes + near_row[2]), inverse[2], near_shift[2]);
        return hn::Max(hn::Max(x, y), hn::Max(z, t_min));
    }
    HWY_INLINE V leave(const float* planes, V t_max) const {
        const Lanes d;
        const auto x = hn::MulAdd(hn::LoadU(d, planes + far_row[0]), inverse[0], far_shift[0]);
        const auto y = hn::MulAdd(hn::LoadU(d, planes + far_row[1]), inverse[1], far_shift[1]);
        const auto z = hn::MulAdd(hn::LoadU(d, planes + far_row[2]), inverse[2], far_shift[2]);
        return hn::Min(hn::Min(x, y), hn::Min(z, t_max));
    }

    // The nearest child that the ray meets before t_max, or kNothing; the others go onto the stack, the farthest first.
    HWY_INLINE flat::Child visit(const flat::Node& node, float t_max, Stack& stack) const {
        const Lanes d;
        const float* planes = node.lower[0];
        const std::uint32_t order = node.order[octant];
        if constexpr (hn::MaxLanes(Lanes()) == flat::kWidth) {
            const hn::RebindToUnsigned<Lanes> du;
            const auto near = enter(planes), far = leave(planes, hn::Set(d, t_max));
            const auto slots = hn::And(hn::Shr(hn::Set(du, order), hn::ShiftLeft<2>(hn::Iota(du, 0))), hn::Set(du, 7));
            const auto sorted = hn::IndicesFromVec(d, hn::BitCast(hn::RebindToSigned<Lanes>(), slots));
            const auto near_sorted = hn::TableLookupLanes(near, sorted);
            const auto met = hn::Le(near_sorted, hn::TableLookupLanes(far, sorted));
            const std::uint32_t mask = bits(met);
            if (mask == 0) return flat::kNothing;
            const int nearest = 31 - std::countl_zero(mask);
            const flat::Child next = node.child[order >> (4 * nearest) & 7];
            const auto others = hn::TableLookupLanes(hn::BitCast(d, hn::LoadU(du, node.child)), sorted);
            hn::StoreU(hn::BitCast(du, hn::Compress(others, met)), du, stack.child + stack.size);
            hn::StoreU(hn::Compress(near_sorted, met), d, stack.near + stack.size);
            stack.size += static_cast<std::size_t>(std::popcount(mask)) - 1;
            return next;
        } else {
            HWY_ALIGN float near[flat::kWidth];
            std::uint32_t mask = 0;
            for (std::size_t i = 0; i < flat::kWidth; i += hn::Lanes(d)) {
                const auto t = enter(planes + i);
                hn::StoreU(t, d, near + i);
                mask |= bits(hn::Le(t, leave(planes + i, hn::Set(d, t_max)))) << i;
            }
            if (mask == 0) return flat::kNothing;
            for (std::uint32_t slots = order, k = 0; k < flat::kWidth; ++k, slots >>= 4) {
                const std::uint32_t i = slots & 7;
                if ((mask >> i & 1) == 0) continue;
                stack.child[stack.size] = node.child[i];
                stack.near[stack.size++] = near[i];
            }
            return stack.child[--stack.size];
        }
    }
};

}  // namespace limn::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
