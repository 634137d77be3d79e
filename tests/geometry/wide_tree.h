// What holds for any tree of the wide builder.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "catch.h"
#include "geometry/bvh/wide_bvh.h"

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

inline accel::FloatBox box_of(const accel::Node& node, std::size_t slot) {
    return {{node.planes[0][slot], node.planes[1][slot], node.planes[2][slot]},
            {node.planes[3][slot], node.planes[4][slot], node.planes[5][slot]}};
}

inline double half_area(const accel::FloatBox& b) {
    const double x = double{b.upper[0]} - b.lower[0], y = double{b.upper[1]} - b.lower[1],
                 z = double{b.upper[2]} - b.lower[2];
    return x * y + y * z + z * x;
}

inline accel::FloatBox merged(const std::vector<accel::FloatBox>& boxes) {
    accel::FloatBox all{{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (const accel::FloatBox& b : boxes)
        for (std::size_t a = 0; a < 3; ++a)
            all.lower[a] = std::min(all.lower[a], b.lower[a]), all.upper[a] = std::max(all.upper[a], b.upper[a]);
    return all;
}

// Of everything. \pre there is a node
inline accel::FloatBox bounds_of(const accel::WideBvh& bvh) {
    std::vector<accel::FloatBox> boxes;
    for (std::size_t slot = 0; slot < accel::kWidth; ++slot) boxes.push_back(box_of(bvh.nodes.at(0), slot));
    return merged(boxes);
}

// What a random ray that meets the root is expected to cost.
inline double expected_cost(const accel::WideBvh& bvh, const accel::BuildSettings& settings) {
    double sum = settings.node_cost;
    for (const accel::Node& node : bvh.nodes)
        for (std::size_t slot = 0; slot < accel::kWidth && node.child[slot] != accel::kNothing; ++slot) {
            const bool is_leaf = (node.child[slot] & accel::kLeaf) != 0;
            const std::uint32_t count = is_leaf ? bvh.leaves[node.child[slot] & ~accel::kLeaf].count : 0;
            const double cost =
                is_leaf ? std::ceil(double(count) / settings.leaf_width) * settings.leaf_cost : settings.node_cost;
            sum += cost * half_area(box_of(node, slot)) / half_area(bounds_of(bvh));
        }
    return sum;
}

inline bool same_bits(const accel::WideBvh& a, const accel::WideBvh& b) {
    return a.nodes.size() == b.nodes.size() && a.leaves.size() == b.leaves.size() && a.indices == b.indices &&
           std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(accel::Node)) == 0 &&
           std::memcmp(a.leaves.data(), b.leaves.data(), a.leaves.size() * sizeof(accel::Leaf)) == 0 &&
           a.cost == b.cost;
}

class TreeCheck {
public:
    TreeCheck(const accel::WideBvh& bvh, const std::vector<accel::FloatBox>& boxes,
              const accel::BuildSettings& settings)
        : bvh_(bvh),
          boxes_(boxes),
          settings_(settings),
          is_in_leaf_(bvh.indices.size(), false),
          seen_(boxes.size(), 0) {}

    // Returns how many nodes the longest path has.
    int run() {
        const int depth = bvh_.nodes.empty() ? 0 : check(0, bounds_of(bvh_));
        CHECK(depth <= accel::kMaxWideDepth);
        CHECK(next_leaf_ == bvh_.leaves.size());
        CHECK(nodes_ == bvh_.nodes.size());
        for (std::size_t i = 0; i < boxes_.size(); ++i) REQUIRE(seen_[i] == (is_empty(boxes_[i]) ? 0 : 1));
        return depth;
    }

private:
    int check(std::uint32_t row, const accel::FloatBox& around) {
        const accel::Node& node = bvh_.nodes.at(row);
        ++nodes_;
        bool present = true;
        for (std::size_t slot = 0; slot < accel::kWidth; ++slot) {
            const std::uint32_t child = node.child[slot];
            if (child == accel::kNothing) {
                REQUIRE(slot > 0);
                for (std::size_t a = 0; a < 3; ++a)
                    REQUIRE((node.planes[a][slot] == INFINITY && node.planes[3 + a][slot] == -INFINITY));
                present = false;
                continue;
            }
            REQUIRE(present);  // present ones come first
            REQUIRE(contains(around, box_of(node, slot)));
            if ((child & accel::kLeaf) != 0) check_leaf(child & ~accel::kLeaf, box_of(node, slot));
        }
        int depth = 1;
        for (std::size_t slot = 0; slot < accel::kWidth; ++slot)
            if ((node.child[slot] & accel::kLeaf) == 0)
                depth = std::max(depth, 1 + check(node.child[slot], box_of(node, slot)));
        return depth;
    }

    void check_leaf(std::uint32_t row, const accel::FloatBox& box) {
        REQUIRE(row == next_leaf_++);
        const accel::Leaf leaf = bvh_.leaves.at(row);
        REQUIRE((leaf.count > 0 && leaf.count <= settings_.max_leaf));
        for (std::uint32_t i = 0; i < leaf.count; ++i) {
            const std::uint32_t index = bvh_.indices.at(leaf.first + i);
            if (i > 0) REQUIRE(bvh_.indices[leaf.first + i - 1] < index);
            REQUIRE(contains(box, boxes_.at(index)));
            REQUIRE(!is_in_leaf_[leaf.first + i]);
            is_in_leaf_[leaf.first + i] = true;
            ++seen_[index];
        }
    }

    const accel::WideBvh& bvh_;
    const std::vector<accel::FloatBox>& boxes_;
    const accel::BuildSettings& settings_;
    std::vector<bool> is_in_leaf_;  // by place in the indices
    std::vector<int> seen_;
    std::uint32_t next_leaf_ = 0;
    std::size_t nodes_ = 0;
};

// Checks it all; returns how many nodes the longest path has.
inline int check_tree(const std::vector<accel::FloatBox>& boxes, const accel::BuildSettings& settings = {}) {
    const accel::WideBvh bvh = accel::build_wide_bvh(boxes, settings);
    return TreeCheck(bvh, boxes, settings).run();
}

// Of a tree by exact sweeps over sorted centres, whose node is opened into eight by opening the largest first; for
// leaves of up to eight, tested at once.
class ReferenceTree {
public:
    static double cost(std::vector<accel::FloatBox> boxes) {
        const double area = half_area(merged(boxes));
        return node_cost(std::move(boxes)) / area;
    }

private:
    using Boxes = std::vector<accel::FloatBox>;

    static double node_cost(Boxes boxes) {
        double cost = half_area(merged(boxes));
        std::vector<Boxes> children{std::move(boxes)};
        while (children.size() < accel::kWidth) {
            std::size_t largest = children.size();
            for (std::size_t i = 0; i < children.size(); ++i)
                if (children[i].size() > 8 && (largest == children.size() ||
                                               half_area(merged(children[i])) > half_area(merged(children[largest]))))
                    largest = i;
            if (largest == children.size()) break;
            auto [lower, upper] = split(std::move(children[largest]));
            children[largest] = std::move(lower);
            children.push_back(std::move(upper));
        }
        for (Boxes& child : children)
            cost += child.size() <= 8 ? half_area(merged(child)) : node_cost(std::move(child));
        return cost;
    }

    static std::pair<Boxes, Boxes> split(Boxes boxes) {
        double least = INFINITY;
        std::pair<Boxes, Boxes> best;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::sort(boxes.begin(), boxes.end(), [&](const accel::FloatBox& a, const accel::FloatBox& b) {
                return a.lower[axis] + a.upper[axis] < b.lower[axis] + b.upper[axis];
            });
            const std::size_t n = boxes.size();
            std::vector<double> upper_area(n);
            accel::FloatBox side = merged({});
            for (std::size_t i = n; i-- > 1;) upper_area[i] = half_area(side = merged({side, boxes[i]}));
            side = merged({});
            std::size_t middle = 0;
            for (std::size_t i = 1; i < n; ++i) {
                side = merged({side, boxes[i - 1]});
                const double cost = half_area(side) * double((i + 7) / 8) + upper_area[i] * double((n - i + 7) / 8);
                if (cost < least) least = cost, middle = i;
            }
            if (middle == 0) continue;
            const auto at = boxes.begin() + static_cast<std::ptrdiff_t>(middle);
            best = {Boxes(boxes.begin(), at), Boxes(at, boxes.end())};
        }
        return best;
    }
};

inline double reference_cost(const std::vector<accel::FloatBox>& boxes) { return ReferenceTree::cost(boxes); }

}  // namespace limn::test
