#include "geometry/bvh/wide_bvh.h"

#include <deque>
#include <utility>

#include "geometry/bvh/collapse.h"
#include "geometry/bvh/gather.h"
#include "geometry/bvh/grid.h"
#include "geometry/bvh/subtree.h"
#include "math/parallel.h"

namespace limn::accel {

namespace {

// Builds the binary tree over all bounded boxes. Its upper part is split by grids; each range below is a job for a
// SubtreeBuilder.
class TreeBuilder {
public:
    // `indices` receives the indices of the primitives, in the order of the leaves.
    TreeBuilder(const BuildSettings& settings, std::uint32_t* indices) : settings_(settings), indices_(indices) {}

    // Builds the tree below `root`. Returns its costs.
    ForestCosts build(BuildPrimitive* primitives, BuildPrimitive* spare, const Range& range, SplitNode& root) {
        root.begin = range.begin;
        root.end = range.end;
        split(primitives, spare, range, root);
        for_all(0, jobs_.size(), 1, [this](std::size_t i) {
            Job& job = jobs_[i];
            if (job.range.size() == 0) job.range = range_over(job.primitives, job.node->begin, job.node->end);
            job.costs = job.builder.build(job.primitives, job.spare, job.range, *job.node);
        });
        std::size_t next_job = 0;
        return plan(root, next_job);
    }

private:
    struct Job {
        BuildPrimitive *primitives, *spare;
        Range range;  // empty if it hasn't been computed yet
        SplitNode* node;
        SubtreeBuilder builder;
        ForestCosts costs;
    };

    // Splits the node by grids and adds a job for each leaf of this upper part.
    void split(BuildPrimitive* primitives, BuildPrimitive* spare, const Range& range, SplitNode& node) {
        if (node.size() <= kSubtree || !has_extent(range) || !may_split(node)) {
            jobs_.push_back({primitives, spare, range, &node, {settings_, indices_}, {}});
            return;
        }
        for (SplitNode* leaf : split_by_grid(primitives, spare, range, settings_, node, nodes_))
            split(spare, primitives, leaf->size() > kSubtree ? range_over_many(spare, leaf->begin, leaf->end) : Range(),
                  *leaf);
    }

    // Plans the upper part. `next_job` is the job of the first leaf that hasn't been visited; jobs are in the order of
    // their nodes, depth first.
    ForestCosts plan(SplitNode& node, std::size_t& next_job) {
        if (next_job < jobs_.size() && jobs_[next_job].node == &node) return jobs_[next_job++].costs;
        const ForestCosts left = plan((*node.children)[0], next_job), right = plan((*node.children)[1], next_job);
        return plan_node(node, left, right, settings_);
    }

    const BuildSettings& settings_;
    std::uint32_t* indices_;
    std::deque<SplitNodes> nodes_;  // nodes of the upper part
    std::deque<Job> jobs_;
};

// The tree over the unbounded boxes, which the surface-area heuristic can't split. The boxes are halved by their number
// down to leaves. The root of this tree is a child of the wide root.
struct UnboundedTree {
    std::span<const FloatBox> boxes;
    std::span<const std::uint32_t> indices;
    const BuildSettings& settings;
    std::deque<SplitNodes> nodes = {};
    double cost = 0;

    void halve(SplitNode& node) {
        if (node.size() <= settings.max_leaf) {
            cost += leaf_cost(node.size(), settings);
            for (const std::uint32_t i : indices.subspan(node.begin, node.size())) node.box.extend(to_bounds(boxes[i]));
            return;
        }
        cost += settings.node_cost;
        auto& [left, right] = add_children(node, nodes);
        left.begin = node.begin;
        left.end = right.begin = node.begin + node.size() / 2;
        right.end = node.end;
        for (SplitNode* child : {&left, &right}) {
            halve(*child);
            node.box.extend(child->box);
        }
        node.is_leaf = false;
        // Plan a wide node of two children.
        node.open_from = kWidth;
        node.left_slots[kWidth] = 1;
    }
};

}  // namespace

WideBvh build_wide_bvh(std::span<const FloatBox> boxes, const BuildSettings& settings) {
    // Sort the boxes into bounded and unbounded ones.
    const Gathered gathered = gather(boxes);
    const Range& range = gathered.range;
    HugeVector<std::uint32_t> indices(range.size() + gathered.unbounded.size());
    std::ranges::copy(gathered.unbounded, indices.begin() + range.size());

    // Build the binary tree over the bounded boxes.
    TreeBuilder builder(settings, indices.data());
    UnboundedTree unbounded{boxes, indices, settings};
    const bool has_unbounded = !gathered.unbounded.empty();
    SplitNode root, apart{.begin = range.size(), .end = static_cast<std::uint32_t>(indices.size())};
    Slots top;  // the children of the wide root
    double cost = 0;
    if (range.size() > 0) {
        const PrimitiveArray spare = allocate_primitives(range.size());
        const ForestCosts costs = builder.build(gathered.primitives.get(), spare.get(), range, root);
        top.add(root, has_unbounded ? kWidth - 1 : kWidth);
        cost = costs[has_unbounded ? kWidth - 2 : 0] / half_area(root.box);
    }
    // Build the tree over the unbounded boxes beside it.
    if (has_unbounded) {
        unbounded.halve(apart);
        top.add(apart, 1);
    }
    if (top.count == 0) return {};
    // Add the cost of the wide root, unless the plan has it, and collapse both trees.
    if (root.is_leaf || has_unbounded) cost += settings.node_cost + unbounded.cost;
    WideBvh bvh = assemble(top, std::move(indices));
    bvh.cost = cost;
    return bvh;
}

}  // namespace limn::accel
