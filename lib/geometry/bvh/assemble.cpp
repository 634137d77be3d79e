#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "geometry/bvh/collapse.h"
#include "math/parallel.h"

namespace limn::accel {

namespace {

constexpr std::uint32_t kPart = 1 << 14;  // most primitives of a part, whose nodes one thread writes

// A number of nodes and leaves of the wide tree, or the rows of the next ones.
struct Rows {
    std::uint32_t node = 0, leaf = 0;

    void operator+=(const Rows& r) {
        node += r.node;
        leaf += r.leaf;
    }
};

// Returns the children with the largest box last. A ray that looks for any hit visits children from the last to the
// first, and a large child is likely to have one (Ogaki, Derouet-Jourdan, An N-ary BVH Child Node Sorting Technique for
// Occlusion Tests, JCGT 5(2), 2016).
Slots sorted(Slots children) {
    const auto is_smaller = [](const SplitNode* a, const SplitNode* b) {
        return half_area(a->box) < half_area(b->box);
    };
    // Insert each child behind those that are not larger. Equal ones keep their order.
    const auto first = std::begin(children.node);
    for (auto child = first; child != first + children.count; ++child)
        std::rotate(std::upper_bound(first, child, *child, is_smaller), child, child + 1);
    return children;
}

Slots children_of(const SplitNode& node) {
    Slots children;
    children.add(node, kWidth);
    return sorted(children);
}

// Writes all nodes and leaves depth first. A part is a subtree of at most kPart primitives below the top of the tree.
// First the rows of each part are counted. Then one thread writes the top, and the parts are written in parallel.
class Assembler {
public:
    explicit Assembler(HugeVector<std::uint32_t> indices) { bvh_.indices = std::move(indices); }

    WideBvh build(const Slots& root) {
        // Count the rows of the top and of each part.
        const bool at_top = bvh_.indices.size() > kPart;
        Rows all = count(root, at_top);
        for_all(0, parts_.size(), 1,
                [&](std::size_t i) { parts_[i].size = count(children_of(*parts_[i].root), false); });
        for (const Part& part : parts_) all += part.size;
        bvh_.nodes.resize(all.node);
        bvh_.leaves.resize(all.leaf);
        // Write the top, which decides where each part begins, then the parts.
        Rows next;
        write(root, next, at_top);
        for_all(0, parts_.size(), 1, [&](std::size_t i) {
            Rows at = parts_[i].first;
            write(children_of(*parts_[i].root), at, false);
        });
        return std::move(bvh_);
    }

private:
    struct Part {
        const SplitNode* root;
        Rows size = {}, first = {};  // number of its rows, and its first rows
    };

    static bool is_part(const SplitNode& node, bool at_top) { return at_top && node.size() <= kPart; }

    // Returns the number of rows of a node with these children and its subtree. Parts are appended to `parts_` and not
    // counted if `at_top`.
    Rows count(const Slots& children, bool at_top) {
        Rows rows{1, 0};
        for (const SplitNode* child : children) {
            if (child->is_leaf)
                ++rows.leaf;
            else if (is_part(*child, at_top))
                parts_.push_back({child});
            else
                rows += count(children_of(*child), at_top);
        }
        return rows;
    }

    // Writes a node with these children and its subtree from row `next` on. If `at_top`, parts are only given their
    // first rows.
    void write(const Slots& children, Rows& next, bool at_top) {
        Node& node = bvh_.nodes[next.node++] = node_over(children);
        // Write the leaves.
        for (std::size_t slot = 0; slot < children.count; ++slot) {
            if (!children.node[slot]->is_leaf) continue;
            node.child[slot] = kLeaf | next.leaf;
            const SplitNode& leaf = *children.node[slot];
            std::ranges::sort(std::span(bvh_.indices).subspan(leaf.begin, leaf.size()));
            bvh_.leaves[next.leaf++] = {leaf.begin, leaf.size()};
        }
        // Write the subtrees of the other children.
        for (std::size_t slot = 0; slot < children.count; ++slot) {
            const SplitNode& child = *children.node[slot];
            if (child.is_leaf) continue;
            node.child[slot] = next.node;
            if (!is_part(child, at_top)) {
                write(children_of(child), next, at_top);
                continue;
            }
            Part& part = parts_[next_part_++];
            part.first = next;
            next += part.size;
        }
    }

    WideBvh bvh_;
    std::vector<Part> parts_;
    std::size_t next_part_ = 0;
};

}  // namespace

Node node_over(const Slots& children) {
    constexpr float kFar = std::numeric_limits<float>::infinity();
    // Write the boxes.
    Node node;
    std::fill_n(node.child, kWidth, kNothing);
    for (int a = 0; a < 3; ++a) {
        std::fill_n(node.planes[a], kWidth, kFar);
        std::fill_n(node.planes[3 + a], kWidth, -kFar);
        for (std::size_t c = 0; c < children.count; ++c) {
            const Bounds& box = children.node[c]->box;
            node.planes[a][c] = box.lower[a];
            node.planes[3 + a][c] = box.upper[a];
        }
    }
    const auto present = static_cast<std::uint32_t>(children.count);
    // Write the orders. The order of the opposite octant is the reverse.
    for (std::uint32_t octant = 0; octant < 4; ++octant) {
        float along[kWidth];              // twice the projection of each centre onto the octant's diagonal
        std::uint32_t rank[kWidth] = {};  // the nearest child has rank 0
        for (std::uint32_t c = 0; c < kWidth; ++c) {
            const float x = node.planes[0][c] + node.planes[3][c], y = node.planes[1][c] + node.planes[4][c],
                        z = node.planes[2][c] + node.planes[5][c];
            along[c] = (octant & 1 ? -x : x) + (octant & 2 ? -y : y) + z;
        }
        // `along` is NaN for an absent child and NaN or infinite for an unbounded one. Sort both last.
        for (std::uint32_t c = 0; c < kWidth; ++c)
            if (!(along[c] < kFar)) along[c] = kFar;
        for (std::uint32_t other = 0; other < kWidth; ++other)
            for (std::uint32_t c = 0; c < kWidth; ++c)
                rank[c] +=
                    static_cast<std::uint32_t>(along[other] < along[c]) |
                    (static_cast<std::uint32_t>(along[other] == along[c]) & static_cast<std::uint32_t>(other < c));
        std::uint32_t word = 0, opposite = 0;
        for (std::uint32_t c = 0; c < kWidth; ++c) {
            word |= c << 4 * (kWidth - 1 - rank[c]);
            opposite |= c << 4 * (kWidth - 1 - (c < present ? present - 1 - rank[c] : rank[c]));
        }
        node.order[octant] = word;
        node.order[7 - octant] = opposite;
    }
    return node;
}

WideBvh assemble(const Slots& root, HugeVector<std::uint32_t> indices) {
    return Assembler(std::move(indices)).build(sorted(root));
}

}  // namespace limn::accel
