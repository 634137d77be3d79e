// The part of a tree over references few enough for one thread and its cache.
#pragma once

#include <vector>

#include "accel/collapse.h"
#include "accel/reference.h"

namespace limn::accel {

// No path in the binary tree has more nodes.
inline constexpr int kMaxSplitDepth = kMaxWideDepth - 2;

// Whether splits by area may be as uneven as they like, or boxes must be halved from here on for the depth to stay
// within its limit.
bool may_split(std::uint32_t size, int depth);

// Rows count from the part's own first. A part of one leaf has no node.
struct Part {
    std::vector<WideNode> nodes;
    std::vector<Leaf> leaves;
    std::vector<std::uint32_t> ids;
    double cost = 0;  // times the root's area
};

// `references` has what is in the range; it and `spare`, as large, are used up. \pre the range is not empty
Part build_subtree(Reference* references, Reference* spare, const Range& range, int depth,
                   const BuildSettings& settings);

}  // namespace limn::accel
