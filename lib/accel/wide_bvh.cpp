#include "accel/wide_bvh.h"

#include <oneapi/tbb/parallel_for.h>

#include <deque>
#include <memory>

#include "accel/assemble.h"
#include "accel/gather.h"
#include "accel/grid.h"
#include "accel/subtree.h"

namespace limn::accel {

namespace {

constexpr std::uint32_t kSubtree = 4096;  // references that one thread sorts, in its second-level cache

// Stich, Friedrich and Dietrich found this good for all their scenes, as a part of the root's area.
constexpr double kLeastOverlap = 1e-5;

// The binary tree over all bounded boxes.
class TreeBuilder {
public:
    TreeBuilder(const Range& range, const BuildSettings& settings, const Clip* clip)
        : settings_(settings),
          splitting_{settings, clip, kLeastOverlap * half_area(to_box(range.bounds))},
          spare_(range.size() + range.room),
          ids_(range.size() + range.room) {}

    ForestCosts build(Reference* references, const Range& range) {
        if (splitting_.clip != nullptr) {  // cells of a grid cannot be cut
            whole_ = std::make_unique<SubtreeBuilder>(splitting_, ids_.data());
            return whole_->build(references, spare_.data(), range, 1, root_);
        }
        split(references, spare_.data(), {&root_, 1, 0, range.size()}, range);
        if (jobs_.size() == 1) {
            run(jobs_[0]);
        } else {
            tbb::parallel_for(std::size_t{0}, jobs_.size(), [this](std::size_t i) { run(jobs_[i]); });
        }
        std::size_t next_job = 0;
        return plan(root_, next_job);
    }

    const SplitNode& root() const { return root_; }
    std::span<const std::uint32_t> ids() const { return ids_; }

private:
    struct Job {
        Reference *references, *spare;
        OpenRange range;
        SubtreeBuilder builder;
        ForestCosts costs;
    };

    void split(Reference* references, Reference* spare, const OpenRange& open, const Range& range) {
        if (open.size() <= kSubtree) {
            jobs_.push_back({references, spare, open, {splitting_, ids_.data()}, {}});
        } else if (has_extent(range) && may_split(open.size(), open.depth)) {
            for (const OpenRange& part :
                 split_by_grid(references, spare, range, *open.node, open.depth, kSubtree, settings_, nodes_))
                split_further(spare, references, part);
        } else {
            SplitNode& node = *open.node;
            node.box = to_box(range.bounds);
            node.begin = open.begin, node.end = open.end;
            const std::uint32_t middle = open.begin + open.size() / 2;
            node.left = &nodes_.emplace_back();
            split_further(references, spare, {node.left, open.depth + 1, open.begin, middle});
            node.right = &nodes_.emplace_back();
            split_further(references, spare, {node.right, open.depth + 1, middle, open.end});
        }
    }

    void split_further(Reference* references, Reference* spare, const OpenRange& open) {
        split(references, spare, open,
              open.size() > kSubtree ? range_over_many(references, open.begin, open.end) : Range());
    }

    void run(Job& job) {
        const Range range = range_over(job.references, job.range.begin, job.range.end);
        job.costs = job.builder.build(job.references, job.spare, range, job.range.depth, *job.range.node);
    }

    // Jobs stand in the order of their nodes, depth first.
    ForestCosts plan(SplitNode& node, std::size_t& next_job) {
        if (next_job < jobs_.size() && jobs_[next_job].range.node == &node) return jobs_[next_job++].costs;
        const ForestCosts left = plan(*node.left, next_job), right = plan(*node.right, next_job);
        return plan_node(node, left, right, settings_);
    }

    const BuildSettings& settings_;
    Splitting splitting_;
    std::unique_ptr<SubtreeBuilder> whole_;
    ReferenceArray spare_;
    HugeVector<std::uint32_t> ids_;
    SplitNode root_;
    std::deque<SplitNode> nodes_;  // at the top
    std::deque<Job> jobs_;
};

}  // namespace

WideBvh build_wide_bvh(std::span<const FloatBox> boxes, const BuildSettings& settings, const Clip* clip) {
    if (!settings.spatial_splits) clip = nullptr;
    const auto room =
        clip == nullptr ? 0 : static_cast<std::uint32_t>(settings.room * static_cast<double>(boxes.size()));
    Gathered gathered = gather(boxes, room);
    Aside aside = set_aside(boxes, gathered.unbounded, settings);
    if (gathered.range.size() == 0) return assemble(nullptr, {}, {}, std::move(aside), settings);
    TreeBuilder tree(gathered.range, settings, clip);
    const ForestCosts costs = tree.build(gathered.references.data(), gathered.range);
    return assemble(&tree.root(), costs, tree.ids(), std::move(aside), settings);
}

}  // namespace limn::accel
