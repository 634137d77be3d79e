#include "accel/subtree.h"

#include <oneapi/tbb/parallel_invoke.h>

#include <algorithm>
#include <utility>

#include "accel/binning.h"
#include "accel/spatial_split.h"

namespace limn::accel {

namespace {

constexpr std::uint32_t kFork = 4096;  // primitives: more are sorted by two threads after a split

// A cut pays off further down too. Lower numbers make more cuts, but not cheaper trees.
constexpr double kCutBonus = 0.95;
constexpr std::uint32_t kMinCut = 64;  // smaller ranges hardly gain by a cut

}  // namespace

bool may_split(std::uint32_t size, int depth) {
    // After one split as uneven as can be, halving the rest takes another bit_width(size) levels at most.
    return depth + 1 + static_cast<int>(std::bit_width(size)) <= kMaxSplitDepth;
}

ForestCosts SubtreeBuilder::build(BuildPrimitive* primitives, BuildPrimitive* spare, const Range& range, int depth,
                                  SplitNode& root) {
    next_ = range.begin;
    // No more than these: nodes do not move.
    nodes_.reserve(range.size() > kFork ? 2 : 2 * std::size_t{range.size() + range.room} - 2);
    return split(primitives, spare, range, depth, root);
}

ForestCosts SubtreeBuilder::split(BuildPrimitive* primitives, BuildPrimitive* spare, const Range& range, int depth,
                                  SplitNode& node) {
    node.box = to_box(range.bounds);
    Range lower, upper;
    if (!divide(primitives, spare, range, depth, lower, upper)) return make_leaf(primitives, range, node);
    ForestCosts left, right;
    if (range.size() > kFork) {
        node.begin = range.begin, node.end = range.end;
        node.left = &nodes_.emplace_back(), node.right = &nodes_.emplace_back();
        lower_ = std::make_unique<SubtreeBuilder>(splitting_, indices_);
        upper_ = std::make_unique<SubtreeBuilder>(splitting_, indices_);
        tbb::parallel_invoke([&] { left = lower_->build(primitives, spare, lower, depth + 1, *node.left); },
                             [&] { right = upper_->build(primitives, spare, upper, depth + 1, *node.right); });
    } else {
        node.begin = next_;
        node.left = &nodes_.emplace_back();
        left = split(primitives, spare, lower, depth + 1, *node.left);
        node.right = &nodes_.emplace_back();
        right = split(primitives, spare, upper, depth + 1, *node.right);
        node.end = next_;
    }
    return plan_node(node, left, right, splitting_.settings);
}

// False if the range is to be a leaf. The sides stand in `primitives`, then.
bool SubtreeBuilder::divide(BuildPrimitive*& primitives, BuildPrimitive*& spare, const Range& range, int depth,
                            Range& lower, Range& upper) const {
    const BuildSettings& settings = splitting_.settings;
    const std::uint32_t size = range.size();
    if (size <= std::min(settings.leaf_width, settings.max_leaf)) return false;
    Split by_center;
    Cut plane;
    if (may_split(size, depth)) {
        by_center = best_split(primitives, range, settings.leaf_width);
        if (splitting_.clip != nullptr && size > kMinCut && range.room > 0 &&
            (!by_center.exists() || overlap(primitives, range, by_center) > splitting_.least_overlap))
            plane = best_cut(primitives, range, settings.leaf_width, *splitting_.clip);
    }
    const double whole = leaf_cost(size, {.leaf_width = settings.leaf_width});
    if (size <= settings.max_leaf && !(std::min(double{by_center.cost}, plane.cost) < whole)) return false;

    if (kCutBonus * plane.cost < by_center.cost &&
        cut(primitives, spare, range, plane, *splitting_.clip, lower, upper)) {
        std::swap(primitives, spare);
        return true;
    }
    std::uint32_t middle = range.begin + size / 2;
    if (by_center.exists()) {
        middle = partition(primitives, spare, range, by_center);
        std::swap(primitives, spare);
    }
    lower = range_over(primitives, range.begin, middle), upper = range_over(primitives, middle, range.end);
    if (range.room > 0) share_room(primitives, range, middle - range.begin, middle, range.end - middle, lower, upper);
    return true;
}

ForestCosts SubtreeBuilder::make_leaf(const BuildPrimitive* primitives, const Range& range, SplitNode& node) {
    node.begin = next_;
    for (std::uint32_t i = range.begin; i < range.end; ++i) indices_[next_++] = primitives[i].index();
    node.end = next_;
    return closed_costs(half_area(node.box) * leaf_cost(node.size(), splitting_.settings));
}

}  // namespace limn::accel
