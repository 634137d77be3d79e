#include "accel/subtree.h"

#include <oneapi/tbb/parallel_invoke.h>

#include <algorithm>
#include <utility>

#include "accel/binning.h"
#include "accel/spatial_split.h"

namespace limn::accel {

namespace {

constexpr std::uint32_t kFork = 4096;  // references: more are sorted by two threads after a split

// A cut pays off further down too. Lower numbers make more cuts, but not cheaper trees.
constexpr double kCutBonus = 0.95;
constexpr std::uint32_t kMinCut = 64;  // smaller ranges hardly gain by a cut

}  // namespace

bool may_split(std::uint32_t size, int depth) {
    // After one split as uneven as can be, halving the rest takes another bit_width(size) levels at most.
    return depth + 1 + static_cast<int>(std::bit_width(size)) <= kMaxSplitDepth;
}

ForestCosts SubtreeBuilder::build(Reference* references, Reference* spare, const Range& range, int depth,
                                  SplitNode& root) {
    next_id_ = range.begin;
    if (range.size() > kFork) return fork(references, spare, range, depth, root);
    nodes_.reserve(2 * std::size_t{range.size() + range.room} - 2);  // no more: nodes do not move
    return split(references, spare, range, depth, root);
}

ForestCosts SubtreeBuilder::split(Reference* references, Reference* spare, const Range& range, int depth,
                                  SplitNode& node) {
    node.box = to_box(range.bounds);
    Range lower, upper;
    if (!divide(references, spare, range, depth, lower, upper)) return make_leaf(references, range, node);
    node.begin = next_id_;
    node.left = &nodes_.emplace_back();
    const ForestCosts left = split(references, spare, lower, depth + 1, *node.left);
    node.right = &nodes_.emplace_back();
    const ForestCosts right = split(references, spare, upper, depth + 1, *node.right);
    node.end = next_id_;
    return plan_node(node, left, right, splitting_.settings);
}

ForestCosts SubtreeBuilder::fork(Reference* references, Reference* spare, const Range& range, int depth,
                                 SplitNode& node) {
    node.box = to_box(range.bounds);
    node.begin = range.begin, node.end = range.end;
    Range lower, upper;
    divide(references, spare, range, depth, lower, upper);
    nodes_.resize(2);
    node.left = &nodes_[0], node.right = &nodes_[1];
    lower_ = std::make_unique<SubtreeBuilder>(splitting_, ids_);
    upper_ = std::make_unique<SubtreeBuilder>(splitting_, ids_);
    ForestCosts left, right;
    tbb::parallel_invoke([&] { left = lower_->build(references, spare, lower, depth + 1, *node.left); },
                         [&] { right = upper_->build(references, spare, upper, depth + 1, *node.right); });
    return plan_node(node, left, right, splitting_.settings);
}

// False if the range is to be a leaf. The sides stand in `references`, then.
bool SubtreeBuilder::divide(Reference*& references, Reference*& spare, const Range& range, int depth, Range& lower,
                            Range& upper) const {
    const BuildSettings& settings = splitting_.settings;
    const std::uint32_t size = range.size();
    if (size <= std::min(settings.leaf_width, settings.max_leaf)) return false;
    Split by_center;
    Cut plane;
    if (may_split(size, depth)) {
        by_center = best_split(references, range, settings.leaf_width);
        if (splitting_.clip != nullptr && size > kMinCut && range.room > 0 &&
            (!by_center.exists() || overlap(references, range, by_center) > splitting_.least_overlap))
            plane = best_cut(references, range, settings.leaf_width, *splitting_.clip);
    }
    const double whole = leaf_cost(size, {.leaf_width = settings.leaf_width});
    if (size <= settings.max_leaf && !(std::min(double{by_center.cost}, plane.cost) < whole)) return false;

    if (kCutBonus * plane.cost < by_center.cost &&
        cut(references, spare, range, plane, *splitting_.clip, lower, upper)) {
        std::swap(references, spare);
        return true;
    }
    std::uint32_t middle = range.begin + size / 2;
    if (by_center.exists()) {
        middle = partition(references, spare, range, by_center);
        std::swap(references, spare);
    }
    lower = range_over(references, range.begin, middle), upper = range_over(references, middle, range.end);
    if (range.room > 0) share_room(references, range, middle - range.begin, middle, range.end - middle, lower, upper);
    return true;
}

ForestCosts SubtreeBuilder::make_leaf(const Reference* references, const Range& range, SplitNode& node) {
    node.begin = next_id_;
    for (std::uint32_t i = range.begin; i < range.end; ++i) ids_[next_id_++] = references[i].id();
    node.end = next_id_;
    return closed_costs(half_area(node.box) * leaf_cost(node.size(), splitting_.settings));
}

}  // namespace limn::accel
