// What holds for any tree of the wide builder.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "accel/wide_bvh.h"
#include "catch.h"

namespace limn::test {

inline std::vector<accel::FloatBox> random_boxes(std::size_t count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<accel::FloatBox> boxes(count);
    for (accel::FloatBox& b : boxes)
        for (std::size_t a = 0; a < 3; ++a) b.lower[a] = unit(random), b.upper[a] = b.lower[a] + unit(random) / 10;
    return boxes;
}

inline bool is_empty(const accel::FloatBox& b) {
    return !(b.lower[0] <= b.upper[0] && b.lower[1] <= b.upper[1] && b.lower[2] <= b.upper[2]);
}

inline bool contains(const accel::FloatBox& outer, const accel::FloatBox& inner) {
    for (std::size_t a = 0; a < 3; ++a)
        if (!(outer.lower[a] <= inner.lower[a] && inner.upper[a] <= outer.upper[a])) return false;
    return true;
}

inline accel::FloatBox box_of(const accel::WideNode& node, std::size_t slot) {
    return {{node.lower[0][slot], node.lower[1][slot], node.lower[2][slot]},
            {node.upper[0][slot], node.upper[1][slot], node.upper[2][slot]}};
}

// Area over the root's; what is infinite counts as large as all that is finite.
inline double share(const accel::FloatBox& box, const accel::FloatBox& root) {
    const auto area = [](const accel::FloatBox& b) {
        const double x = double{b.upper[0]} - b.lower[0], y = double{b.upper[1]} - b.lower[1],
                     z = double{b.upper[2]} - b.lower[2];
        return x * y + y * z + z * x;
    };
    return area(box) / area(root);
}

class TreeCheck {
public:
    TreeCheck(const accel::WideBvh& bvh, const std::vector<accel::FloatBox>& boxes,
              const accel::BuildSettings& settings)
        : bvh_(bvh), boxes_(boxes), settings_(settings), seen_(boxes.size(), 0) {}

    // Returns how many nodes the longest path has.
    int run() {
        const int depth = bvh_.nodes.empty() ? 0 : check(0, bvh_.bounds);
        CHECK(depth <= accel::kMaxWideDepth);
        CHECK(next_leaf_ == bvh_.leaves.size());
        CHECK(nodes_ == bvh_.nodes.size());
        for (std::size_t i = 0; i < boxes_.size(); ++i) REQUIRE(seen_[i] == (is_empty(boxes_[i]) ? 0 : 1));
        return depth;
    }

private:
    int check(std::uint32_t row, const accel::FloatBox& around) {
        using accel::WideNode;
        const WideNode& node = bvh_.nodes.at(row);
        ++nodes_;
        bool present = true;
        for (std::size_t slot = 0; slot < accel::kWidth; ++slot) {
            const std::uint32_t child = node.child[slot];
            if (child == WideNode::kAbsent) {
                REQUIRE(slot > 0);
                for (std::size_t a = 0; a < 3; ++a)
                    REQUIRE((node.lower[a][slot] == INFINITY && node.upper[a][slot] == -INFINITY));
                present = false;
                continue;
            }
            REQUIRE(present);  // present ones come first
            REQUIRE(contains(around, box_of(node, slot)));
            if ((child & WideNode::kLeaf) != 0) check_leaf(child & ~WideNode::kLeaf, box_of(node, slot));
        }
        int depth = 1;
        for (std::size_t slot = 0; slot < accel::kWidth; ++slot)
            if ((node.child[slot] & WideNode::kLeaf) == 0)
                depth = std::max(depth, 1 + check(node.child[slot], box_of(node, slot)));
        return depth;
    }

    void check_leaf(std::uint32_t row, const accel::FloatBox& box) {
        REQUIRE(row == next_leaf_++);
        const accel::Leaf leaf = bvh_.leaves.at(row);
        REQUIRE(leaf.first == next_id_);
        REQUIRE((leaf.count > 0 && leaf.count <= settings_.max_leaf));
        next_id_ += leaf.count;
        for (std::uint32_t i = 0; i < leaf.count; ++i) {
            const std::uint32_t id = bvh_.ids.at(leaf.first + i);
            if (i > 0) REQUIRE(bvh_.ids[leaf.first + i - 1] < id);
            REQUIRE(contains(box, boxes_.at(id)));
            ++seen_[id];
        }
    }

    const accel::WideBvh& bvh_;
    const std::vector<accel::FloatBox>& boxes_;
    const accel::BuildSettings& settings_;
    std::vector<int> seen_;
    std::uint32_t next_leaf_ = 0, next_id_ = 0;
    std::size_t nodes_ = 0;
};

// Checks it all; returns how many nodes the longest path has.
inline int check_tree(const std::vector<accel::FloatBox>& boxes, const accel::BuildSettings& settings = {}) {
    const accel::WideBvh bvh = accel::build_wide_bvh(boxes, settings);
    return TreeCheck(bvh, boxes, settings).run();
}

}  // namespace limn::test
