#include "accel/wide_bvh.h"

#include <deque>
#include <utility>

#include "accel/assemble.h"
#include "accel/gather.h"
#include "accel/grid.h"
#include "accel/parallel.h"
#include "accel/subtree.h"

namespace limn::accel {

namespace {

constexpr std::uint32_t kSubtree = 4096;  // build primitives that one thread sorts, in its second-level cache

// The binary tree over all bounded boxes.
class TreeBuilder {
public:
    // `indices` gets those of the primitives, at their places in the tree.
    TreeBuilder(const BuildSettings& settings, std::uint32_t* indices) : settings_(settings), indices_(indices) {}

    ForestCosts build(BuildPrimitive* primitives, BuildPrimitive* spare, const Range& range, SplitNode& root) {
        split(primitives, spare, {&root, 1, range.begin, range.end}, range);
        for_all(0, jobs_.size(), 1, [this](std::size_t i) { run(jobs_[i]); });
        std::size_t next_job = 0;
        return plan(root, next_job);
    }

private:
    struct Job {
        BuildPrimitive *primitives, *spare;
        OpenRange open;
        Range range;  // empty where it is yet to be found out
        SubtreeBuilder builder;
        ForestCosts costs;
    };

    void split(BuildPrimitive* primitives, BuildPrimitive* spare, const OpenRange& open, const Range& range) {
        if (open.size() <= kSubtree || !has_extent(range) || !may_split(open.size(), open.depth)) {
            jobs_.push_back({primitives, spare, open, range, {settings_, indices_}, {}});
            return;
        }
        for (const OpenRange& part : split_by_grid(primitives, spare, open, range, kSubtree, settings_, nodes_))
            split(spare, primitives, part,
                  part.size() > kSubtree ? range_over_many(spare, part.begin, part.end) : Range());
    }

    static void run(Job& job) {
        if (job.range.size() == 0) job.range = range_over(job.primitives, job.open.begin, job.open.end);
        job.costs = job.builder.build(job.primitives, job.spare, job.range, job.open.depth, *job.open.node);
    }

    // Jobs stand in the order of their nodes, depth first.
    ForestCosts plan(SplitNode& node, std::size_t& next_job) {
        if (next_job < jobs_.size() && jobs_[next_job].open.node == &node) return jobs_[next_job++].costs;
        const ForestCosts left = plan(*node.left, next_job), right = plan(*node.right, next_job);
        return plan_node(node, left, right, settings_);
    }

    const BuildSettings& settings_;
    std::uint32_t* indices_;
    std::deque<SplitNode> nodes_;  // at the top
    std::deque<Job> jobs_;
};

// Boxes that no split by area can part stand beside the tree of all others, halved down to leaves.
struct UnboundedTree {
    std::span<const FloatBox> boxes;
    std::span<const std::uint32_t> indices;
    const BuildSettings& settings;
    std::deque<SplitNode> nodes = {};
    double cost = 0;

    SplitNode* build(std::uint32_t begin, std::uint32_t end) {
        SplitNode& node = nodes.emplace_back();
        node.begin = begin, node.end = end;
        Bounds bounds = kEmpty;
        if (node.size() <= settings.max_leaf) {
            cost += leaf_cost(node.size(), settings);
            for (const std::uint32_t i : indices.subspan(begin, node.size())) bounds.extend(to_bounds(boxes[i]));
        } else {
            cost += settings.node_cost;
            const std::uint32_t middle = begin + node.size() / 2;
            node.left = build(begin, middle), node.right = build(middle, end);
            bounds.extend(to_bounds(node.left->box));
            bounds.extend(to_bounds(node.right->box));
            node.is_leaf = false;
            node.open_from = kWidth, node.left_slots[kWidth] = 1;  // a wide node of two children
        }
        node.box = to_box(bounds);
        return &node;
    }
};

}  // namespace

WideBvh build_wide_bvh(std::span<const FloatBox> boxes, const BuildSettings& settings) {
    const Gathered gathered = gather(boxes);
    const Range& range = gathered.range;
    HugeVector<std::uint32_t> indices(range.size() + gathered.unbounded.size());
    std::ranges::copy(gathered.unbounded, indices.begin() + range.size());

    TreeBuilder builder(settings, indices.data());
    UnboundedTree unbounded{boxes, indices, settings};
    const bool has_unbounded = !gathered.unbounded.empty();
    SplitNode root;
    Slots top;  // of the wide root
    double cost = 0;
    if (range.size() > 0) {
        const PrimitiveArray spare = allocate_primitives(range.size());
        const ForestCosts costs = builder.build(gathered.primitives.get(), spare.get(), range, root);
        fill_slots(root, has_unbounded ? kWidth - 1 : kWidth, top);
        cost = costs[has_unbounded ? kWidth - 2 : 0] / half_area(root.box);
    }
    if (has_unbounded) top.add(*unbounded.build(range.size(), static_cast<std::uint32_t>(indices.size())));
    if (top.count == 0) return {};
    if (root.is_leaf || has_unbounded) cost += settings.node_cost + unbounded.cost;
    WideBvh bvh = assemble(top, std::move(indices));
    bvh.cost = cost;
    return bvh;
}

}  // namespace limn::accel
