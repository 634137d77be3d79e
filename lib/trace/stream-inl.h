// Searches the tree with up to 64 rays together. The include guard is per target, as Highway requires.
#if defined(LIMN_TRACE_STREAM_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_TRACE_STREAM_INL_H
#undef LIMN_TRACE_STREAM_INL_H
#else
#define LIMN_TRACE_STREAM_INL_H
#endif

#include <bit>
#include <cstring>
#include <new>

#include "trace/traversal-inl.h"

#if HWY_MAX_BYTES >= 32

HWY_BEFORE_NAMESPACE();
namespace limn::trace::HWY_NAMESPACE {

// A stream of rays whose directions are in the same octant. A node is loaded once and tested against each ray that
// reaches it; the rays are the bits of a mask. These tests are independent of each other, and no branch depends on one
// of them before all are done. Children are visited in the order of the octant, or in their own order if not
// Traversal::kSorts. If only few rays reach a node, each walks on alone. Query is Closest or Any; each ray has its own.
template <unsigned kKinds, class Query>
class Stream {
public:
    static constexpr std::size_t kMost = 64;

    explicit Stream(const flat::Scene& scene) : scene_(scene), blas_(flat::blas_at(scene, BlasId::root)) {}
    ~Stream() {}

    bool is_full() const { return count_ == kMost; }

    // Adds a ray, unless it is not ordinary; then returns false. Ray and query must live until run(). \pre !is_full()
    HWY_INLINE bool add(const Ray& ray, Query& query) {
        const Slot* const slot = new (&slots_[count_]) Slot(scene_, blas_, ray, query);
        count_ += slot->is_ordinary ? 1 : 0;
        return slot->is_ordinary;
    }

    // Searches with all rays, and empties the stream.
    HWY_NOINLINE void run() {
        if (count_ != 0 && blas_.root != flat::kNothing) {
            run_together(~std::uint64_t{0} >> (kMost - count_));
            for (std::size_t i = 0; i < count_; ++i) slots_[i].walk.finish();
        }
        count_ = 0;
    }

private:
    // The least number of rays that take less time together than alone.
    static constexpr int kFew = 5;

    using One = Traversal<true, kKinds, Query>;
    struct Slot {
        RayFrame frame;
        WalkRay ray;
        bool is_ordinary;
        One walk;

        HWY_INLINE Slot(const flat::Scene& scene, const flat::Blas& blas, const Ray& source, Query& query)
            : frame(source),
              is_ordinary(set_up<kKinds, /*kIsExact*/ true>(ray_in_world(source), source, blas, kFar, ray)),
              walk(scene, blas, ray, frame, nullptr, 0, query) {}
    };
    // A child to be visited, and the rays that reach it.
    struct Entry {
        flat::Child child;
        std::uint64_t rays;
    };

    // Calls visit(walk) for each of the rays. If it returns true, the search of that ray has ended.
    template <class Visit>
    HWY_INLINE void for_each_of(std::uint64_t rays, const Visit& visit) {
        for (; rays != 0; rays &= rays - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(rays));
            if (visit(slots_[i].walk)) ended_ |= std::uint64_t{1} << i;
        }
    }

    void run_together(std::uint64_t all) {
        ended_ = 0;
        Entry stack[flat::kMaxStack];
        std::size_t size = 1;
        stack[0] = {blas_.root, all};
        const unsigned octant = slots_[0].ray.octant;
        while (size != 0) {
            const Entry entry = stack[--size];
            const std::uint64_t rays = entry.rays & ~ended_;
            if (rays == 0) continue;
            if ((entry.child & flat::kLeaf) != 0) {
                for_each_of(rays, [&](One& walk) HWY_ATTR { return walk.leaf(entry.child); });
                continue;
            }
            if (std::popcount(rays) < kFew) {
                for_each_of(rays, [&](One& walk) HWY_ATTR { return walk.run_from(entry.child); });
                continue;
            }
            // Push the children that any ray meets, the farthest first or in their order.
            const flat::Node& node = scene_.nodes[entry.child];
            std::uint64_t meeting[flat::kWidth];
            test(node, octant, rays, meeting);
            const std::uint32_t order = One::kSorts ? node.order[octant] : 0x76543210;
            for (std::uint32_t k = 0, slots = order; k < flat::kWidth; ++k, slots >>= 4) {
                const std::uint32_t child = slots & 7;
                stack[size] = {node.child[child], meeting[child]};
                size += meeting[child] != 0 ? 1 : 0;
            }
        }
    }

    // Sets meeting[i] to the rays that meet child i of a node.
    HWY_INLINE void test(const flat::Node& node, unsigned octant, std::uint64_t rays,
                         std::uint64_t (&meeting)[flat::kWidth]) {
        // Test each ray. It has a byte, with a bit for each child.
        const BoxPlanes planes(node.planes[0], octant);
        const hn::CappedTag<std::uint8_t, kMost> bytes;
        alignas(64) std::uint8_t met[kMost];
        for (std::size_t i = 0; i < kMost; i += hn::Lanes(bytes)) hn::Store(hn::Zero(bytes), bytes, met + i);
        for (; rays != 0; rays &= rays - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(rays));
            const BoxHits hits = test_boxes<true>(planes, BoxRay(slots_[i].ray, slots_[i].walk.bound()));
            met[i] = static_cast<std::uint8_t>(~bits(hits.missed));
        }
        // Collect the bits of each child.
        for (std::size_t child = 0; child < flat::kWidth; ++child) {
            std::uint8_t mask[kMost / 8];
            for (std::size_t i = 0; i < kMost; i += hn::Lanes(bytes)) {
                const auto bit = hn::Set(bytes, static_cast<std::uint8_t>(1u << child));
                hn::StoreMaskBits(bytes, hn::TestBit(hn::Load(bytes, met + i), bit), mask + i / 8);
            }
            std::memcpy(&meeting[child], mask, sizeof(mask));
        }
    }

    const flat::Scene& scene_;
    const flat::Blas& blas_;
    std::size_t count_ = 0;
    std::uint64_t ended_ = 0;
    union {
        Slot slots_[kMost];  // the first count_ are constructed
    };
};

}  // namespace limn::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

#endif
