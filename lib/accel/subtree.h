// The binary tree over references few enough for one thread and its cache.
#pragma once

#include <span>
#include <vector>

#include "accel/collapse.h"
#include "accel/reference.h"

namespace limn::accel {

// No path in the binary tree has more nodes.
inline constexpr int kMaxSplitDepth = kMaxWideDepth - 2;

// Whether a split may be as uneven as it likes, or boxes must be halved from here on for the depth to stay within its
// limit.
bool may_split(std::uint32_t size, int depth);

class SubtreeBuilder {
public:
    // `ids` gets the numbers of the references, at their places in the tree.
    SubtreeBuilder(const BuildSettings& settings, std::uint32_t* ids) : settings_(settings), ids_(ids) {}

    // Fills in `root` and adds what is under it. `references` has what is in the range; both it and `spare`, of the
    // same rows, are used up. \pre the range is not empty; once only
    ForestCosts build(Reference* references, Reference* spare, const Range& range, int depth, SplitNode& root);

private:
    ForestCosts split(Reference* references, Reference* spare, const Range& range, int depth, SplitNode& node);
    ForestCosts make_leaf(const Reference* references, const SplitNode& node);

    const BuildSettings& settings_;
    std::uint32_t* ids_;
    std::vector<SplitNode> nodes_;
};

}  // namespace limn::accel
