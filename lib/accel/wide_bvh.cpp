#include "accel/wide_bvh.h"

#include <algorithm>
#include <cmath>

#include "accel/order.h"
#include "accel/split_tree.h"

namespace limn::accel {

namespace {

constexpr float kEndless = std::numeric_limits<float>::infinity();

// Beyond it a box counts as unbounded: sums and differences of two such coordinates could overflow.
constexpr float kBounded = 0x1p125f;

WideNode empty_node() {
    WideNode node{};
    for (std::size_t a = 0; a < 3; ++a) {
        std::fill_n(node.lower[a], kWidth, kEndless);
        std::fill_n(node.upper[a], kWidth, -kEndless);
    }
    std::fill_n(node.child, kWidth, WideNode::kAbsent);
    return node;
}

void set_box(WideNode& node, std::size_t slot, const float* lower, const float* upper) {
    for (std::size_t a = 0; a < 3; ++a) node.lower[a][slot] = lower[a], node.upper[a][slot] = upper[a];
}

void extend(FloatBox& box, const float* lower, const float* upper) {
    for (std::size_t a = 0; a < 3; ++a) {
        box.lower[a] = std::min(box.lower[a], lower[a]);
        box.upper[a] = std::max(box.upper[a], upper[a]);
    }
}

class Builder {
public:
    Builder(std::span<const FloatBox> boxes, const BuildSettings& settings) : boxes_(boxes), settings_(settings) {
        bvh_.bounds = {{kEndless, kEndless, kEndless}, {-kEndless, -kEndless, -kEndless}};
        references_.reserve(boxes.size());
        for (std::uint32_t id = 0; id < boxes.size(); ++id) {
            const FloatBox& box = boxes[id];
            bool empty = false, bounded = true;
            for (std::size_t a = 0; a < 3; ++a) {
                empty = empty || !(box.lower[a] <= box.upper[a]);
                bounded = bounded && box.lower[a] >= -kBounded && box.upper[a] <= kBounded;
            }
            if (empty) continue;
            extend(bvh_.bounds, box.lower, box.upper);
            for (std::size_t a = 0; a < 3; ++a)
                for (const float x : {box.lower[a], box.upper[a]})
                    if (std::isfinite(x)) bvh_.extent = std::max(bvh_.extent, std::abs(static_cast<double>(x)));
            if (!bounded) {
                unbounded_.push_back(id);
                continue;
            }
            const Reference r{{box.lower[0], box.lower[1], box.lower[2], std::bit_cast<float>(id)},
                              {box.upper[0], box.upper[1], box.upper[2], 0}};
            references_.push_back(r);
            range_.add(bounds_of(r));
        }
        range_.end = static_cast<std::uint32_t>(references_.size());
    }

    WideBvh build() && {
        if (references_.empty() && unbounded_.empty()) return std::move(bvh_);
        std::vector<Child> children;
        if (!references_.empty()) {
            build_split_tree(references_, range_, 1, settings_, nodes_);
            root_area_ = half_area(nodes_[0].lower, nodes_[0].upper);
            // Unbounded boxes stand beside the best of all others, for no split can part them by area.
            const std::size_t slots = unbounded_.empty() ? kWidth : kWidth - 1;
            if (nodes_[0].plan.is_leaf) {
                children.push_back({0, true});
            } else {
                spread(0, slots, children);
            }
        }
        bvh_.nodes.push_back(empty_node());
        fill(0, children);
        if (!unbounded_.empty()) place_unbounded(0, children.size(), unbounded_);
        set_order(bvh_.nodes[0]);
        return std::move(bvh_);
    }

private:
    struct Child {
        std::uint32_t row;
        bool is_leaf;
    };

    // The children that make the most of so many slots under a node.
    void spread(std::uint32_t row, std::size_t slots, std::vector<Child>& children) const {
        const auto place = [&](std::uint32_t side, std::size_t its_slots) {
            const Plan& plan = nodes_[side].plan;
            if (its_slots < plan.open_from) {
                children.push_back({side, plan.is_leaf});
            } else {
                spread(side, its_slots, children);
            }
        };
        const std::size_t left = nodes_[row].plan.left_slots[slots - 2];
        place(row + 1, left);
        place(nodes_[row].right, slots - left);
    }

    double share(std::uint32_t row) const {
        return root_area_ > 0 ? half_area(nodes_[row].lower, nodes_[row].upper) / root_area_ : 1;
    }

    void fill(std::uint32_t row, const std::vector<Child>& children) {
        for (std::size_t slot = 0; slot < children.size(); ++slot) {
            const SplitNode& child = nodes_[children[slot].row];
            set_box(bvh_.nodes[row], slot, child.lower, child.upper);
            if (!children[slot].is_leaf) continue;
            bvh_.nodes[row].child[slot] = add_leaf(child);
            bvh_.cost += share(children[slot].row) * leaf_cost(child.end - child.begin);
        }
        std::vector<Child> inner;
        for (std::size_t slot = 0; slot < children.size(); ++slot) {
            if (children[slot].is_leaf) continue;
            const auto next = static_cast<std::uint32_t>(bvh_.nodes.size());
            bvh_.nodes[row].child[slot] = next;
            bvh_.nodes.push_back(empty_node());
            inner.clear();
            spread(children[slot].row, kWidth, inner);
            fill(next, inner);
            set_order(bvh_.nodes[next]);
            bvh_.cost += share(children[slot].row) * settings_.node_cost;
        }
    }

    double leaf_cost(std::uint32_t count) const {
        return (count + settings_.leaf_width - 1) / settings_.leaf_width * settings_.leaf_cost;
    }

    std::uint32_t add_leaf(const SplitNode& node) {
        std::vector<std::uint32_t> ids;
        for (std::uint32_t i = node.begin; i < node.end; ++i) ids.push_back(references_[i].id());
        return add_leaf(ids);
    }

    std::uint32_t add_leaf(std::span<const std::uint32_t> ids) {
        bvh_.leaves.push_back({static_cast<std::uint32_t>(bvh_.ids.size()), static_cast<std::uint32_t>(ids.size())});
        bvh_.ids.insert(bvh_.ids.end(), ids.begin(), ids.end());
        std::sort(bvh_.ids.end() - static_cast<std::ptrdiff_t>(ids.size()), bvh_.ids.end());
        return WideNode::kLeaf | static_cast<std::uint32_t>(bvh_.leaves.size() - 1);
    }

    void place_unbounded(std::uint32_t row, std::size_t slot, std::span<const std::uint32_t> ids) {
        FloatBox box{{kEndless, kEndless, kEndless}, {-kEndless, -kEndless, -kEndless}};
        for (const std::uint32_t id : ids) extend(box, boxes_[id].lower, boxes_[id].upper);
        set_box(bvh_.nodes[row], slot, box.lower, box.upper);
        if (ids.size() <= settings_.max_leaf) {
            bvh_.nodes[row].child[slot] = add_leaf(ids);
            bvh_.cost += leaf_cost(static_cast<std::uint32_t>(ids.size()));
            return;
        }
        const auto next = static_cast<std::uint32_t>(bvh_.nodes.size());
        bvh_.nodes[row].child[slot] = next;
        bvh_.nodes.push_back(empty_node());
        bvh_.cost += settings_.node_cost;
        for (std::size_t k = 0; k < 2; ++k) {
            const std::size_t half = ids.size() / 2;
            place_unbounded(next, k, k == 0 ? ids.first(half) : ids.subspan(half));
        }
        set_order(bvh_.nodes[next]);
    }

    std::span<const FloatBox> boxes_;
    const BuildSettings& settings_;
    std::vector<Reference> references_;
    Range range_;
    std::vector<std::uint32_t> unbounded_;
    std::vector<SplitNode> nodes_;
    double root_area_ = 0;
    WideBvh bvh_;
};

}  // namespace

WideBvh build_wide_bvh(std::span<const FloatBox> boxes, const BuildSettings& settings, const Clip*) {
    return Builder(boxes, settings).build();
}

}  // namespace limn::accel
