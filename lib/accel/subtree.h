// The binary tree over references few enough for one thread and its cache.
#pragma once

#include <memory>
#include <vector>

#include "accel/collapse.h"
#include "accel/reference.h"

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
    // `ids` gets the numbers of the references, at their places in the tree.
    SubtreeBuilder(const Splitting& splitting, std::uint32_t* ids) : splitting_(splitting), ids_(ids) {}

    // Fills in `root` and adds what is under it. `references` has what is in the range; both it and `spare`, of the
    // same rows and room, are used up. \pre the range is not empty; once only
    ForestCosts build(Reference* references, Reference* spare, const Range& range, int depth, SplitNode& root);

private:
    ForestCosts split(Reference* references, Reference* spare, const Range& range, int depth, SplitNode& node);
    bool divide(Reference*& references, Reference*& spare, const Range& range, int depth, Range& lower,
                Range& upper) const;
    ForestCosts fork(Reference* references, Reference* spare, const Range& range, int depth, SplitNode& node);
    ForestCosts make_leaf(const Reference* references, const Range& range, SplitNode& node);

    const Splitting& splitting_;
    std::uint32_t* ids_;
    std::uint32_t next_id_ = 0;
    std::vector<SplitNode> nodes_;
    std::unique_ptr<SubtreeBuilder> lower_, upper_;
};

}  // namespace limn::accel
