// Builds the tree of one BLAS.
#include <algorithm>
#include <cmath>
#include <utility>

#include "flat/pack.h"
#include "flat/pack_list.h"
#include "flat/steps.h"
#include "geometry/bounds.h"
#include "geometry/bvh/float_box.h"
#include "geometry/bvh/slab.h"
#include "geometry/mesh_triangle.h"
#include "limn/math/error.h"
#include "math/parallel.h"

namespace limn::compiler {

namespace {

constexpr std::size_t kGrain = 4096;  // primitives of one task

class BlasTree {
public:
    explicit BlasTree(flat::Scene& scene) : scene_(scene) {}

    void build(flat::Blas& blas) {
        // Store the sizes of the tables below the root's tree.
        if (&blas == &scene_.blases.front())
            scene_.below_root = {scene_.nodes.size(), scene_.lines.size(),      scene_.references.size(),
                                 scene_.kinds,        scene_.stored_primitives, scene_.degenerate};
        // Collect the primitives and their bounds.
        for (std::uint32_t i = 0; i < blas.range_count; ++i) add(blas.first_range + i);
        measure_others();
        blas.bounds = bounds_;
        blas.extent = extent_;
        // Scale the boxes only if float can't hold them. For the root, move primitives from the tree to the list.
        blas.scale = extent_ >= 0x1p-20 && extent_ < 0x1p39 ? 1 : accel::scale_to_one(extent_);
        if (&blas == &scene_.blases.front()) list();
        blas.packed_error = accel::round_up(note_what_is_left());
        scale_boxes(blas.scale);
        // Build the tree. A leaf takes two to three times as long as a node (docs/tried.md).
        accel::WideBvh bvh = accel::build_wide_bvh(boxes_, {.max_leaf = flat::kMaxBlock, .leaf_cost = 2});
        blas.cost = bvh.cost;
        blas.root = pack_tree(std::move(bvh), boxes_, references_, scene_);
    }

private:
    // Adds the primitives of a range, a row of Scene::ranges. Triangles of meshes are measured at once, other
    // primitives later by measure_others().
    void add(std::uint32_t row) {
        const PrimitiveRange& range = scene_.ranges[row];
        if (range.kind == PrimitiveKind::medium) return;  // media aren't in the tree: see place_media()
        const std::uint64_t stored = range.kind == PrimitiveKind::instance ? 1 : range.count;
        const std::size_t first = references_.size();
        if (stored + first >= flat::kLeaf) throw ArgumentError("scene: too many primitives");
        for (std::uint32_t i = 0; i < stored; ++i) references_.push_back({row, i});
        boxes_.resize(references_.size());
        if (range.kind == PrimitiveKind::mesh) return measure_mesh(range, first);
        scene_.stored_primitives += range.kind == PrimitiveKind::instance ? 0 : stored;
        for (std::size_t index = first; index < references_.size(); ++index)
            others_.push_back({.reference = references_[index], .index = static_cast<std::uint32_t>(index)});
    }

    // Computes the boxes of primitives that aren't in meshes.
    void measure_others() {
        for_all(0, others_.size(), kGrain / 16, [&](std::size_t i) { measure(others_[i]); });
        for (const Candidate& other : others_) {
            bounds_.extend(other.box);
            extent_ = std::max(extent_, accel::finite_extent(other.box));
        }
    }

    // Computes the boxes of the triangles of a mesh, whose first reference is `first`. Triangles without area get empty
    // boxes.
    void measure_mesh(const PrimitiveRange& range, std::size_t first) {
        // Compute the boxes in parallel, with their common bounds and the number of degenerate triangles.
        struct Found {
            Box bounds;
            std::size_t degenerate = 0;
        };
        const MeshView& mesh = scene_.meshes[range.first_row].arrays;
        const Found found = join_all<Found>(
            range.count, kGrain,
            [&](Found& so_far, std::size_t i) {
                const TriangleVertices v = triangle_vertices(mesh, i);
                const bool counts = !is_degenerate(v);
                const Box box = triangle_bounds(v);
                boxes_[first + i] = accel::to_float_box(counts ? box : Box());
                if (counts)
                    so_far.bounds.extend(box);
                else
                    ++so_far.degenerate;
            },
            [](const Found& a, const Found& b) {
                return Found{merge(a.bounds, b.bounds), a.degenerate + b.degenerate};
            });
        // Add these to the bounds and counts of the tree and the scene.
        extent_ = std::max(extent_, accel::finite_extent(found.bounds));
        bounds_.extend(found.bounds);
        mesh_bounds_.extend(found.bounds);
        scene_.degenerate += found.degenerate;
        scene_.stored_primitives += range.count - found.degenerate;
        if (range.count > found.degenerate) scene_.kinds |= flat::bit(PrimitiveKind::mesh);
    }

    // Computes the box of a primitive or instance, and the error of packing it.
    void measure(Candidate& other) const {
        const PrimitiveRange& range = scene_.ranges[other.reference.range];
        const std::uint32_t row = range.first_row + other.reference.element;
        if (range.kind == PrimitiveKind::user_defined) {
            other.box = scene_.user_defined[row].bounds;
        } else if (range.kind == PrimitiveKind::instance) {
            const flat::Instance& instance = scene_.instances[row];
            other.box = instance_bounds(instance.world_from_object0, instance.world_from_object1,
                                        flat::blas_at(scene_, instance.blas).bounds);
        } else {
            primitives::with_row(scene_.rows, range.kind, row, [&](const auto& primitive) {
                other.box = primitive.bounds();
                other.packed_error = primitive.packed_error();
            });
        }
    }

    // Multiplies the boxes by a power of two, and converts those that aren't in float yet. A box of floats stays exact,
    // except for numbers so small compared with `extent_` that they would become subnormal.
    void scale_boxes(double scale) {
        if (scale != 1)
            for_all(0, boxes_.size(), kGrain, [&](std::size_t i) {
                accel::FloatBox& box = boxes_[i];
                for (std::size_t a = 0; a < 3; ++a) {
                    box.lower[a] = accel::round_down(scale * static_cast<double>(box.lower[a]));
                    box.upper[a] = accel::round_up(scale * static_cast<double>(box.upper[a]));
                }
            });
        for (const Candidate& other : others_) boxes_[other.index] = accel::to_float_box(other.box, scale);
    }

    // Fills Scene::list. The boxes of listed primitives become empty, which excludes these from the tree.
    void list() {
        if (list_all(scene_)) return;
        const std::vector<bool> is_listed = list_large(scene_, others_, mesh_bounds_);
        Box rest = mesh_bounds_;
        for (std::size_t i = 0; i < is_listed.size(); ++i) {
            if (is_listed[i])
                others_[i].box = Box();
            else
                rest.extend(others_[i].box);
        }
        const accel::FloatBox box = accel::to_float_box(rest);
        std::copy_n(box.lower, 3, scene_.list.rest_lower);
        std::copy_n(box.upper, 3, scene_.list.rest_upper);
    }

    // Adds the kinds of the primitives left in the tree to Scene::kinds. Returns the largest error of packing a
    // triangle or quad of them.
    double note_what_is_left() {
        double packed_error = 0;
        for (const Candidate& other : others_) {
            if (other.box.is_empty()) continue;
            const unsigned kind = flat::bit(scene_.ranges[other.reference.range].kind);
            if ((kind & flat::kPlanarKinds) != 0) packed_error = std::max(packed_error, other.packed_error);
            scene_.kinds |= kind;
        }
        return packed_error;
    }

    flat::Scene& scene_;
    // One element for each primitive: the tree is built over the indices of `boxes_`.
    std::vector<flat::Reference> references_;
    std::vector<accel::FloatBox> boxes_;
    std::vector<Candidate> others_;  // instances, and primitives outside meshes; empty box if listed
    Box bounds_, mesh_bounds_;       // bounds of all primitives, and of those in meshes
    double extent_ = 0;              // the largest finite coordinate
};

}  // namespace

void build_blas_tree(flat::Scene& scene, flat::Blas& blas) { BlasTree(scene).build(blas); }

}  // namespace limn::compiler
