#include "compile/group_tree.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "accel/float_box.h"
#include "accel/slab.h"
#include "compile/pack.h"
#include "core/bounds.h"
#include "core/mesh_triangle.h"
#include "limn/core/error.h"

namespace limn::compiler {

namespace {

constexpr float kFloatInfinity = std::numeric_limits<float>::infinity();
constexpr accel::FloatBox kEmpty{{kFloatInfinity, kFloatInfinity, kFloatInfinity},
                                 {-kFloatInfinity, -kFloatInfinity, -kFloatInfinity}};

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
            others_.push_back(bounds_of(range, i));
            bounds_.extend(others_.back());
            extent_ = std::max(extent_, accel::finite_extent(others_.back()));
        }
        if (stored > 0) scene_.kinds |= flat::bit(range.kind);
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
                boxes_[part.first + i] = counts ? accel::to_float_box(box) : kEmpty;
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

// By a power of two: exact, but for numbers so small beside `extent_` that they become subnormal.
void GroupTree::scale_boxes(double scale) {
    std::size_t next = 0;
    for (const Part& part : parts_) {
        if (part.range.kind != PrimitiveKind::mesh) {
            for (std::size_t i = 0; i < part.count; ++i, ++next) {
                const Box& box = others_[next];
                boxes_[part.first + i] = accel::to_float_box(box, scale);
            }
            continue;
        }
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

void GroupTree::finish(flat::Group& group) {
    int exponent = 0;
    std::frexp(extent_, &exponent);
    // Where float serves, boxes stay as they are.
    exponent = exponent > -20 && exponent < 40 ? 0 : std::max(exponent, -1000);  // so that the scale is finite
    group.bounds = bounds_;
    group.extent = extent_;
    group.scale = std::ldexp(1.0, -exponent);
    scale_boxes(group.scale);
    accel::WideBvh bvh = accel::build_wide_bvh(boxes_, {.max_leaf = flat::kMaxBlock, .leaf_cost = 2});
    group.root = pack_tree(bvh, boxes_, references_, scene_);
}

}  // namespace limn::compiler
