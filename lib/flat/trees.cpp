// Builds the trees of all BLASes, and lists the media.
#include <algorithm>
#include <string>

#include "flat/reach.h"
#include "flat/steps.h"
#include "geometry/bounds.h"
#include "geometry/bvh/slab.h"
#include "limn/math/error.h"

namespace limn::compiler {

namespace {

// Returns true for each BLAS that contains a medium.
std::vector<bool> blases_with_media(const flat::Scene& scene) {
    return blases_that_reach(scene, [](const PrimitiveRange& r) { return r.kind == PrimitiveKind::medium; });
}

// Builds the trees of all BLASes.
class TreeBuilder {
public:
    explicit TreeBuilder(flat::Scene& scene)
        : scene_(scene), height_(scene.blases.size(), kUnbuilt), holds_media_(blases_with_media(scene)) {}

    // Builds the tree of a BLAS after the trees of the BLASes in it, because an instance needs the bounds of its BLAS.
    // Returns the depth of the instances nested in it.
    std::uint32_t build(BlasId id) {
        const auto index = static_cast<std::size_t>(id);
        if (height_[index] != kUnbuilt) return height_[index];
        std::uint32_t height = 0;
        for (const PrimitiveRange& range : flat::ranges_of(scene_, scene_.blases[index])) {
            if (range.kind == PrimitiveKind::instance) {
                height = std::max(height, 1 + build(scene_.instances[range.first_row].blas));
            } else if (range.kind == PrimitiveKind::medium) {
                const BlasId boundary = scene_.medium_shapes[range.first_row].boundary;
                height = std::max(height, build(boundary));
                if (holds_media_[static_cast<std::size_t>(boundary)])
                    throw ArgumentError("scene: the boundary of a medium contains a medium");
            }
        }
        if (height > flat::kMaxNesting)
            throw ArgumentError("scene: instances nest deeper than " + std::to_string(flat::kMaxNesting));
        height_[index] = height;
        build_blas_tree(scene_, scene_.blases[index]);
        return height;
    }

private:
    static constexpr std::uint32_t kUnbuilt = 0xffffffff;

    flat::Scene& scene_;
    std::vector<std::uint32_t> height_;  // depth of the instances nested in each BLAS, or kUnbuilt
    std::vector<bool> holds_media_;      // true for each BLAS that contains a medium
};

// Fills Scene::media. It visits every path of instances that leads to a medium.
class MediumPlacer {
public:
    explicit MediumPlacer(flat::Scene& scene) : scene_(scene), holds_media_(blases_with_media(scene)) {
        visit(BlasId::root, 0);
    }

private:
    // Visits a BLAS, whose first primitive has the given number in the scene.
    void visit(BlasId id, std::uint64_t first_number) {
        if (!holds_media_[static_cast<std::size_t>(id)]) return;
        for (const PrimitiveRange& range : flat::ranges_of(scene_, flat::blas_at(scene_, id))) {
            const std::uint64_t number = first_number + range.first_number;
            if (range.kind == PrimitiveKind::instance) {
                path_.push_back(range.first_row);
                visit(scene_.instances[range.first_row].blas, number);
                path_.pop_back();
            } else if (range.kind == PrimitiveKind::medium) {
                place(range.first_row, number);
            }
        }
    }

    // Adds one occurrence of a medium.
    void place(std::uint32_t shape, std::uint64_t number) {
        flat::Medium medium;
        medium.shape = shape;
        medium.first_instance = static_cast<std::uint32_t>(scene_.medium_instances.size());
        medium.instance_count = static_cast<std::uint32_t>(path_.size());
        medium.first_number = number;
        medium.scattered = largest_albedo(scene_.medium_shapes[shape].phase);
        medium.bounds = flat::blas_at(scene_, scene_.medium_shapes[shape].boundary).bounds;
        for (auto row = path_.rbegin(); row != path_.rend(); ++row) {
            const flat::Instance& instance = scene_.instances[*row];
            medium.bounds = instance_bounds(instance.world_from_object0, instance.world_from_object1, medium.bounds);
        }
        scene_.medium_instances.insert(scene_.medium_instances.end(), path_.begin(), path_.end());
        scene_.media_extent = std::max(scene_.media_extent, accel::finite_extent(medium.bounds));
        scene_.media.push_back(medium);
    }

    // Returns the largest component of the albedo, or 1 if it's unknown.
    double largest_albedo(MaterialId phase) const {
        if (phase == MaterialId::none) return 1;
        const MaterialRecord& m = scene_.materials[static_cast<std::size_t>(phase)];
        if (m.kind != "isotropic" || !flat::is_plain(scene_, m.albedo)) return 1;
        return std::min(1.0, max_component(scene_.textures[static_cast<std::size_t>(m.albedo)].color));
    }

    flat::Scene& scene_;
    std::vector<bool> holds_media_;    // true for each BLAS that contains a medium
    std::vector<std::uint32_t> path_;  // instances around the BLAS being visited, outermost first
};

}  // namespace

void build_trees(flat::Scene& scene) { TreeBuilder(scene).build(BlasId::root); }

void place_media(flat::Scene& scene) { MediumPlacer{scene}; }

}  // namespace limn::compiler
