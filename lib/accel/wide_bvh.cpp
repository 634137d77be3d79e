#include "accel/wide_bvh.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

#include "accel/assemble.h"
#include "accel/gather.h"
#include "accel/grid.h"
#include "accel/subtree.h"

namespace limn::accel {

namespace {

constexpr std::uint32_t kSubtree = 4096;  // references that one thread sorts, in its second-level cache

// The tree over all bounded boxes: binary at the top, with parts at its leaves.
class TreeBuilder {
public:
    TreeBuilder(ReferenceArray& references, ReferenceArray& spare, const BuildSettings& settings)
        : references_(references), spare_(spare), settings_(settings) {}

    Tree build(const Range& range) && {
        tree_.nodes.emplace_back();
        split(references_.data(), spare_.data(), {0, 1, 0, range.size()}, range);
        tree_.parts.resize(tree_.nodes.size());
        if (jobs_.size() == 1) {
            run(jobs_[0]);
        } else {
            tbb::parallel_for(std::size_t{0}, jobs_.size(), [this](std::size_t i) { run(jobs_[i]); });
        }
        tree_.costs = plan(0);
        return std::move(tree_);
    }

private:
    struct Job {
        Reference *references, *spare;
        OpenRange range;
    };

    void split(Reference* references, Reference* spare, const OpenRange& open, const Range& range) {
        if (open.size() <= kSubtree) {
            jobs_.push_back({references, spare, open});
        } else if (has_extent(range) && may_split(open.size(), open.depth)) {
            const std::vector<OpenRange> parts =
                split_by_grid(references, spare, range, open.row, open.depth, kSubtree, settings_, tree_.nodes);
            for (const OpenRange& part : parts) split_further(spare, references, part);
        } else {
            const auto left = static_cast<std::uint32_t>(tree_.nodes.size());
            tree_.nodes.resize(tree_.nodes.size() + 2);
            SplitNode& node = tree_.nodes[open.row];
            node.box = to_box(range.bounds);
            node.begin = open.begin, node.end = open.end;
            node.left = left, node.right = left + 1;
            const std::uint32_t middle = open.begin + open.size() / 2;
            split_further(references, spare, {left, open.depth + 1, open.begin, middle});
            split_further(references, spare, {left + 1, open.depth + 1, middle, open.end});
        }
    }

    void split_further(Reference* references, Reference* spare, const OpenRange& open) {
        split(references, spare, open,
              open.size() > kSubtree ? range_over_many(references, open.begin, open.end) : Range());
    }

    void run(const Job& job) {
        const Range range = range_over(job.references, job.range.begin, job.range.end);
        SplitNode& node = tree_.nodes[job.range.row];
        node.box = to_box(range.bounds);
        node.begin = range.begin, node.end = range.end;
        Part& part = tree_.parts[job.range.row];
        part = build_subtree(job.references, job.spare, range, job.range.depth, settings_);
        node.is_leaf = part.nodes.empty();
    }

    ForestCosts plan(std::uint32_t row) {
        SplitNode& node = tree_.nodes[row];
        if (node.right == 0) return closed_costs(tree_.parts[row].cost);
        const ForestCosts left = plan(node.left), right = plan(node.right);
        return plan_node(node, left, right, settings_);
    }

    ReferenceArray &references_, &spare_;
    const BuildSettings& settings_;
    Tree tree_;
    std::vector<Job> jobs_;
};

}  // namespace

WideBvh build_wide_bvh(std::span<const FloatBox> boxes, const BuildSettings& settings, const Clip*) {
    Gathered gathered = gather(boxes);
    Tree tree;
    if (gathered.range.size() > 0) {
        ReferenceArray spare(gathered.range.size());
        tree = TreeBuilder(gathered.references, spare, settings).build(gathered.range);
    }
    Bounds bounds = gathered.range.bounds;
    Aside aside = set_aside(boxes, gathered.unbounded, settings);
    if (!gathered.unbounded.empty()) bounds.extend(to_bounds(aside.box));
    WideBvh bvh = assemble(std::move(tree), std::move(aside), settings);
    bvh.bounds = to_box(bounds);
    bvh.extent = gathered.extent;
    return bvh;
}

}  // namespace limn::accel
