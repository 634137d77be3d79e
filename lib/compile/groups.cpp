#include "compile/groups.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "accel/binary_bvh.h"
#include "compile/reach.h"
#include "core/bounds.h"
#include "core/mesh_triangle.h"
#include "limn/core/error.h"

namespace limn::compiler {

namespace {

float round_down(double x) {
    const auto f = static_cast<float>(x);
    return f > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}

float round_up(double x) {
    const auto f = static_cast<float>(x);
    return f < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

class TreeBuilder {
public:
    explicit TreeBuilder(flat::Scene& scene)
        : scene_(scene), height_(scene.groups.size(), kUnbuilt), holds_media_(scene.groups.size(), false) {}

    // Inner groups first: an instance needs the bounds of its group. Returns how many instances nest below.
    std::uint32_t build(GroupId id) {
        const auto index = static_cast<std::size_t>(id);
        if (height_[index] != kUnbuilt) return height_[index];
        std::uint32_t height = 0;
        std::vector<Box> boxes;
        std::vector<flat::Reference> references;
        for (std::uint32_t i = 0; i < scene_.groups[index].range_count; ++i) {
            const std::uint32_t row = scene_.groups[index].first_range + i;
            const PrimitiveRange range = scene_.ranges[row];
            if (range.kind == PrimitiveKind::instance) {
                const GroupId inner = scene_.instances[range.first_row].group;
                height = std::max(height, 1 + build(inner));
                if (holds_media_[static_cast<std::size_t>(inner)]) holds_media_[index] = true;
            } else if (range.kind == PrimitiveKind::medium) {
                const GroupId boundary = scene_.medium_shapes[range.first_row].boundary;
                height = std::max(height, build(boundary));
                if (holds_media_[static_cast<std::size_t>(boundary)])
                    throw ArgumentError("scene: the boundary of a medium contains a medium");
                holds_media_[index] = true;
            }
            add(range, row, boxes, references);
        }
        if (height > flat::kMaxNesting)
            throw ArgumentError("scene: instances nest deeper than " + std::to_string(flat::kMaxNesting));
        height_[index] = height;
        const accel::BinaryBvh bvh = accel::build_binary_bvh(boxes);
        scene_.groups[index].bounds = bvh.bounds();
        scene_.groups[index].extent = bvh.extent;
        scene_.groups[index].root = pack(bvh, references);
        return height;
    }

private:
    void add(const PrimitiveRange& range, std::uint32_t row, std::vector<Box>& boxes,
             std::vector<flat::Reference>& references) {
        if (range.kind == PrimitiveKind::medium) return;  // apart, see place_media
        const std::uint64_t stored = range.kind == PrimitiveKind::instance ? 1 : range.count;
        if (stored + references.size() >= flat::Node::kAbsent) throw ArgumentError("scene: too many primitives");
        for (std::uint32_t i = 0; i < stored; ++i) {
            const std::uint32_t r = range.first_row + (range.kind == PrimitiveKind::mesh ? 0 : i);
            Box box;
            switch (range.kind) {
                case PrimitiveKind::sphere: {
                    const flat::Sphere& s = scene_.spheres[r];
                    box = sphere_bounds(s.center, s.center, s.radius);
                    break;
                }
                case PrimitiveKind::moving_sphere: {
                    const flat::MovingSphere& s = scene_.moving_spheres[r];
                    box = sphere_bounds(s.center0, s.center1, s.radius);
                    break;
                }
                case PrimitiveKind::triangle: {
                    const flat::Triangle& t = scene_.triangles[r];
                    box = triangle_bounds({t.a, t.b, t.c});
                    break;
                }
                case PrimitiveKind::quad: {
                    const flat::Quad& q = scene_.quads[r];
                    box = quad_bounds(q.corner, q.edge_u, q.edge_v);
                    break;
                }
                case PrimitiveKind::mesh: {
                    const TriangleVertices v = triangle_vertices(scene_.meshes[r].arrays, i);
                    if (is_degenerate(v)) {
                        ++scene_.degenerate;
                        continue;
                    }
                    box = triangle_bounds(v);
                    break;
                }
                case PrimitiveKind::instance: {
                    const flat::Instance& instance = scene_.instances[r];
                    box = instance_bounds(instance.world_from_object0, instance.world_from_object1,
                                          flat::group_at(scene_, instance.group).bounds);
                    break;
                }
                case PrimitiveKind::foreign: box = scene_.foreign[r].bounds; break;
                case PrimitiveKind::medium: break;
            }
            scene_.kinds |= flat::bit(range.kind);
            scene_.stored_primitives += range.kind != PrimitiveKind::instance;
            boxes.push_back(box);
            references.push_back({row, i});
        }
    }

    // Copies the tree behind what is packed already; returns the row of its root.
    std::uint32_t pack(const accel::BinaryBvh& bvh, const std::vector<flat::Reference>& references) {
        const auto root = static_cast<std::uint32_t>(scene_.nodes.size());
        const auto first_reference = static_cast<std::uint32_t>(scene_.references.size());
        for (const std::uint32_t id : bvh.ids) scene_.references.push_back(references[id]);
        // A node holds the boxes of its children, so a tree of one leaf, or of nothing, needs a node above it.
        const bool lone = bvh.nodes.empty() || bvh.nodes.front().count > 0;
        if (lone) {
            scene_.nodes.push_back(empty_node());
            if (!bvh.nodes.empty()) set_child(scene_.nodes.back(), 0, bvh.nodes.front(), first_reference, {});
            return root;
        }
        std::vector<std::uint32_t> row(bvh.nodes.size(), 0);  // of inner nodes
        std::uint32_t next = root;
        for (std::size_t i = 0; i < bvh.nodes.size(); ++i)
            if (bvh.nodes[i].count == 0) row[i] = next++;
        for (const accel::BinaryNode& node : bvh.nodes) {
            if (node.count > 0) continue;
            flat::Node packed = empty_node();
            for (std::size_t side = 0; side < 2; ++side)
                set_child(packed, side, bvh.nodes[node.first + side], first_reference, row[node.first + side]);
            scene_.nodes.push_back(packed);
        }
        return root;
    }

    static flat::Node empty_node() {
        flat::Node node{};
        for (std::size_t side = 0; side < 2; ++side) {
            node.count[side] = flat::Node::kAbsent;
            for (std::size_t a = 0; a < 3; ++a) {
                node.lower[side][a] = std::numeric_limits<float>::infinity();
                node.upper[side][a] = -std::numeric_limits<float>::infinity();
            }
        }
        return node;
    }

    static void set_child(flat::Node& node, std::size_t side, const accel::BinaryNode& child,
                          std::uint32_t first_reference, std::uint32_t row) {
        for (std::size_t a = 0; a < 3; ++a) {
            node.lower[side][a] = round_down(child.bounds.lower[a]);
            node.upper[side][a] = round_up(child.bounds.upper[a]);
        }
        node.count[side] = child.count;
        node.child[side] = child.count > 0 ? first_reference + child.first : row;
    }

    static constexpr std::uint32_t kUnbuilt = 0xffffffff;

    flat::Scene& scene_;
    std::vector<std::uint32_t> height_;  // by group
    std::vector<bool> holds_media_;      // by group
};

// Walks every path of instances that leads to a medium.
class MediumPlacer {
public:
    explicit MediumPlacer(flat::Scene& scene)
        : scene_(scene),
          holds_media_(
              groups_that_reach(scene, [](const PrimitiveRange& r) { return r.kind == PrimitiveKind::medium; })) {
        visit(GroupId::root, 0);
    }

private:
    void visit(GroupId id, std::uint64_t first_number) {
        if (!holds_media_[static_cast<std::size_t>(id)]) return;
        const flat::Group group = flat::group_at(scene_, id);
        for (std::uint32_t i = 0; i < group.range_count; ++i) {
            const PrimitiveRange range = scene_.ranges[group.first_range + i];
            const std::uint64_t number = first_number + range.first_number;
            if (range.kind == PrimitiveKind::instance) {
                path_.push_back(range.first_row);
                visit(scene_.instances[range.first_row].group, number);
                path_.pop_back();
            } else if (range.kind == PrimitiveKind::medium) {
                place(range.first_row, number);
            }
        }
    }

    void place(std::uint32_t shape, std::uint64_t number) {
        flat::Medium medium;
        medium.shape = shape;
        medium.first_instance = static_cast<std::uint32_t>(scene_.medium_instances.size());
        medium.instance_count = static_cast<std::uint32_t>(path_.size());
        medium.first_number = number;
        medium.bounds = flat::group_at(scene_, scene_.medium_shapes[shape].boundary).bounds;
        for (auto row = path_.rbegin(); row != path_.rend(); ++row) {
            const flat::Instance& instance = scene_.instances[*row];
            medium.bounds = instance_bounds(instance.world_from_object0, instance.world_from_object1, medium.bounds);
        }
        scene_.medium_instances.insert(scene_.medium_instances.end(), path_.begin(), path_.end());
        scene_.media.push_back(medium);
    }

    flat::Scene& scene_;
    std::vector<bool> holds_media_;
    std::vector<std::uint32_t> path_;
};

}  // namespace

void build_trees(flat::Scene& scene) { TreeBuilder(scene).build(GroupId::root); }

void place_media(flat::Scene& scene) { MediumPlacer{scene}; }

}  // namespace limn::compiler
