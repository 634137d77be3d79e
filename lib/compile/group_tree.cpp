#include "compile/group_tree.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "accel/clip_triangle.h"
#include "accel/float_box.h"
#include "accel/slab.h"
#include "compile/pack.h"
#include "limn/core/error.h"
#include "predicates/bounds.h"
#include "predicates/mesh_triangle.h"

namespace limn::compiler {

namespace {

// Cuts triangles of meshes, and the boxes of everything else. \pre boxes are not scaled: vertices are as they are
class TriangleClip final : public accel::Clip {
public:
    TriangleClip(const flat::Scene& scene, std::span<const flat::Reference> references)
        : scene_(scene), references_(references) {}

    Parts cut(std::uint32_t primitive, const accel::FloatBox& box, int axis, float position) const override {
        const flat::Reference& reference = references_[primitive];
        const PrimitiveRange& range = scene_.ranges[reference.range];
        if (range.kind != PrimitiveKind::mesh) {
            Parts parts{box, box};
            parts.lower.upper[axis] = std::min(box.upper[axis], position);
            parts.upper.lower[axis] = std::max(box.lower[axis], position);
            return parts;
        }
        const MeshView& mesh = scene_.meshes[range.first_row].arrays;
        const Index3 corner = mesh.triangles[reference.element];
        const Float3 a = mesh.vertices[corner.a], b = mesh.vertices[corner.b], c = mesh.vertices[corner.c];
        return accel::clip_triangle({{a.x, a.y, a.z}, {b.x, b.y, b.z}, {c.x, c.y, c.z}}, box, axis, position);
    }

private:
    const flat::Scene& scene_;
    std::span<const flat::Reference> references_;
};

// How far a number moves when it is packed as float.
double lost(double x) { return std::abs(x - static_cast<double>(static_cast<float>(x))); }

double lost(const Point3& p) { return std::max({lost(p.x), lost(p.y), lost(p.z)}); }

// The same for a sum, whose own rounding is exact in double (difference_up).
double lost(const Point3& p, const Vec3& edge) {
    double most = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        const double sum = p[a] + edge[a], added = sum - p[a], rounding = (p[a] - (sum - added)) + (edge[a] - added);
        most = std::max(most, lost(sum) + std::abs(rounding));
    }
    return most;
}

using Indices = oneapi::tbb::blocked_range<std::size_t>;
constexpr std::size_t kGrain = 4096;

}  // namespace

void GroupTree::add(const PrimitiveRange& range, std::uint32_t row) {
    if (range.kind == PrimitiveKind::medium) return;  // apart, see place_media
    const std::uint64_t stored = range.kind == PrimitiveKind::instance ? 1 : range.count;
    if (stored + references_.size() >= flat::kLeaf) throw ArgumentError("scene: too many primitives");
    parts_.push_back({range, references_.size(), stored});
    for (std::uint32_t i = 0; i < stored; ++i) references_.push_back({row, i});
    boxes_.resize(references_.size());
    if (range.kind == PrimitiveKind::mesh) {
        measure_mesh(parts_.back());
    } else {
        scene_.stored_primitives += range.kind == PrimitiveKind::instance ? 0 : stored;
        for (std::uint32_t i = 0; i < stored; ++i) {
            others_.push_back({{row, i}, bounds_of(range, i)});
            bounds_.extend(others_.back().box);
            extent_ = std::max(extent_, accel::finite_extent(others_.back().box));
        }
    }
}

void GroupTree::measure_mesh(const Part& part) {
    struct Found {
        Box bounds;
        std::size_t degenerate = 0;
    };
    const MeshView& mesh = scene_.meshes[part.range.first_row].arrays;
    const Found found = oneapi::tbb::parallel_reduce(
        Indices(0, part.count, kGrain), Found{},
        [&](const Indices& indices, Found so_far) {
            for (std::size_t i = indices.begin(); i < indices.end(); ++i) {
                const TriangleVertices v = triangle_vertices(mesh, i);
                const bool counts = !is_degenerate(v);
                const Box box = triangle_bounds(v);
                boxes_[part.first + i] = accel::to_float_box(counts ? box : Box());
                if (counts)
                    so_far.bounds.extend(box);
                else
                    ++so_far.degenerate;
            }
            return so_far;
        },
        [](const Found& a, const Found& b) {
            return Found{merge(a.bounds, b.bounds), a.degenerate + b.degenerate};
        });
    extent_ = std::max(extent_, accel::finite_extent(found.bounds));
    bounds_.extend(found.bounds);
    mesh_bounds_.extend(found.bounds);
    scene_.degenerate += found.degenerate;
    scene_.stored_primitives += part.count - found.degenerate;
    if (part.count > found.degenerate) scene_.kinds |= flat::bit(PrimitiveKind::mesh);
}

Box GroupTree::bounds_of(const PrimitiveRange& range, std::uint32_t element) const {
    const std::uint32_t row = range.first_row + element;
    switch (range.kind) {
        case PrimitiveKind::sphere: {
            const flat::Sphere& s = scene_.spheres[row];
            return sphere_bounds(s.center, s.center, s.radius);
        }
        case PrimitiveKind::moving_sphere: {
            const flat::MovingSphere& s = scene_.moving_spheres[row];
            return sphere_bounds(s.center0, s.center1, s.radius);
        }
        case PrimitiveKind::triangle: {
            const flat::Triangle& t = scene_.triangles[row];
            return triangle_bounds({t.a, t.b, t.c});
        }
        case PrimitiveKind::quad: {
            const flat::Quad& q = scene_.quads[row];
            return quad_bounds(q.corner, q.edge_u, q.edge_v);
        }
        case PrimitiveKind::instance: {
            const flat::Instance& instance = scene_.instances[row];
            return instance_bounds(instance.world_from_object0, instance.world_from_object1,
                                   flat::group_at(scene_, instance.group).bounds);
        }
        case PrimitiveKind::foreign: return scene_.foreign[row].bounds;
        case PrimitiveKind::mesh:
        case PrimitiveKind::medium: break;
    }
    return {};
}

double GroupTree::packed_error_of(const PrimitiveRange& range, std::uint32_t element) const {
    const std::uint32_t row = range.first_row + element;
    switch (range.kind) {
        case PrimitiveKind::sphere: return lost(scene_.spheres[row].center);
        case PrimitiveKind::moving_sphere: {  // whose way between two floats is rounded three times
            const flat::MovingSphere& s = scene_.moving_spheres[row];
            const double largest = std::max(max_abs(s.center0), max_abs(s.center1));
            return std::max(lost(s.center0), lost(s.center1)) + 0x1p-22 * largest;
        }
        case PrimitiveKind::triangle: {
            const flat::Triangle& t = scene_.triangles[row];
            return std::max({lost(t.a), lost(t.b), lost(t.c)});
        }
        case PrimitiveKind::quad: {
            const flat::Quad& q = scene_.quads[row];
            return std::max({lost(q.corner), lost(q.corner, q.edge_u), lost(q.corner, q.edge_v)});
        }
        case PrimitiveKind::mesh:
        case PrimitiveKind::instance:
        case PrimitiveKind::foreign:
        case PrimitiveKind::medium: break;
    }
    return 0;
}

// By a power of two: exact, but for numbers so small beside `extent_` that they become subnormal.
void GroupTree::scale_boxes(double scale) {
    std::size_t next = 0;
    for (const Part& part : parts_) {
        if (part.range.kind != PrimitiveKind::mesh) {
            for (std::size_t i = 0; i < part.count; ++i, ++next) {
                const Box& box = others_[next].box;
                boxes_[part.first + i] = accel::to_float_box(box, scale);
            }
            continue;
        }
        if (scale == 1) continue;
        oneapi::tbb::parallel_for(Indices(part.first, part.first + part.count, kGrain), [&](const Indices& indices) {
            for (std::size_t i = indices.begin(); i < indices.end(); ++i)
                for (std::size_t a = 0; a < 3; ++a) {
                    accel::FloatBox& box = boxes_[i];
                    box.lower[a] = accel::round_down(scale * static_cast<double>(box.lower[a]));
                    box.upper[a] = accel::round_up(scale * static_cast<double>(box.upper[a]));
                }
        });
    }
}

// Leaves out of the tree what is listed beside it.
void GroupTree::list() {
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
    std::copy_n(box.lower, 3, scene_.list.rest_lower), std::copy_n(box.upper, 3, scene_.list.rest_upper);
}

void GroupTree::note_what_is_left() {
    for (const Candidate& other : others_) {
        if (other.box.is_empty()) continue;
        const PrimitiveRange& range = scene_.ranges[other.reference.range];
        packed_error_ = std::max(packed_error_, packed_error_of(range, other.reference.element));
        scene_.kinds |= flat::bit(range.kind);
    }
}

void GroupTree::finish(flat::Group& group, bool cut_triangles) {
    group.bounds = bounds_;
    group.extent = extent_;
    // Where float serves, boxes stay as they are.
    group.scale = extent_ >= 0x1p-20 && extent_ < 0x1p39 ? 1 : accel::scale_to_one(extent_);
    if (&group == &scene_.groups.front()) list();
    note_what_is_left();
    group.packed_error = accel::round_up(packed_error_);
    scale_boxes(group.scale);
    // A leaf takes two to three times as long as a node (docs/performance.md).
    const TriangleClip clip(scene_, references_);
    const bool may_cut = cut_triangles && group.scale == 1;
    accel::WideBvh bvh =
        accel::build_wide_bvh(boxes_, {.max_leaf = flat::kMaxBlock, .leaf_cost = 2}, may_cut ? &clip : nullptr);
    group.cost = bvh.cost;
    group.root = pack_tree(std::move(bvh), boxes_, references_, scene_);
}

}  // namespace limn::compiler
