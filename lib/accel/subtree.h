// The binary tree over build primitives few enough for one thread and its cache, or over any number that may be cut.
#pragma once

#include <memory>
#include <vector>

#include "accel/build_primitive.h"
#include "accel/collapse.h"

namespace limn::accel {

// No path in the binary tree has more nodes.
inline constexpr int kMaxSplitDepth = kMaxWideDepth - 2;

// Whether a split may be as uneven as it likes, or boxes must be halved from here on for the depth to stay within its
// limit.
bool may_split(std::uint32_t size, int depth);

// How the splits of a tree are chosen.
struct Splitting {
    const BuildSettings& settings;
    const Clip* clip = nullptr;  // without it no box is cut
    double least_overlap = 0;    // half the area that sides must have in common for a cut to be thought of
};

class SubtreeBuilder {
public:
    // `indices` gets those of the primitives, at their places in the tree.
    SubtreeBuilder(const Splitting& splitting, std::uint32_t* indices) : splitting_(splitting), indices_(indices) {}

    // Fills in `root` and adds what is under it. `primitives` has what is in the range; both it and `spare`, of the
    // same rows and room, are used up. \pre the range is not empty; once only
    ForestCosts build(BuildPrimitive* primitives, BuildPrimitive* spare, const Range& range, int depth,
                      SplitNode& root);

private:
    ForestCosts split(BuildPrimitive* primitives, BuildPrimitive* spare, const Range& range, int depth,
                      SplitNode& node);
    bool divide(BuildPrimitive*& primitives, BuildPrimitive*& spare, const Range& range, int depth, Range& lower,
                Range& upper) const;
    ForestCosts make_leaf(const BuildPrimitive* primitives, const Range& range, SplitNode& node);

    const Splitting& splitting_;
    std::uint32_t* indices_;
    std::uint32_t next_ = 0;  // of the indices
    std::vector<SplitNode> nodes_;
    std::unique_ptr<SubtreeBuilder> lower_, upper_;
};

}  // namespace limn::accel
