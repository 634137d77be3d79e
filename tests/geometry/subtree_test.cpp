#include "geometry/bvh/subtree.h"

#include <cmath>

#include "catch.h"

namespace limn::subtree_test {

using accel::BuildPrimitive;
using accel::SplitNode;

namespace {

int depth_of(const SplitNode& node) {
    return node.children == nullptr ? 1 : 1 + std::max(depth_of((*node.children)[0]), depth_of((*node.children)[1]));
}

}  // namespace

TEST_CASE("SubtreeBuilder: boxes that part one by one do so until halving the rest just keeps the limit of depth",
          "[accel]") {
    for (const float side : {1.0f, -1.0f})
        for (const int above : {1, 20}) {
            std::vector<BuildPrimitive> primitives;
            for (int power = -140; power < 120; ++power) {
                const float x = std::ldexp(side, power), low = std::min(x, 1.1f * x), high = std::max(x, 1.1f * x);
                primitives.emplace_back(accel::to_bounds({{low, low, low}, {high, high, high}}),
                                        static_cast<std::uint32_t>(primitives.size()));
            }
            const auto size = static_cast<std::uint32_t>(primitives.size());
            const accel::BuildSettings settings{.max_leaf = 1, .leaf_width = 1};
            std::vector<std::uint32_t> indices(size);
            std::vector<BuildPrimitive> spare(size);
            SplitNode root;
            root.depth = static_cast<std::uint8_t>(above);
            accel::SubtreeBuilder builder(settings, indices.data());
            builder.build(primitives.data(), spare.data(), accel::range_over(primitives.data(), 0, size), root);
            const int depth = above - 1 + depth_of(root);
            CHECK(depth <= accel::kMaxSplitDepth);
            CHECK(depth > accel::kMaxSplitDepth - 5);
        }
}

}  // namespace limn::subtree_test
