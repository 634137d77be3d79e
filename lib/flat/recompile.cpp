// Moves instances of a flat scene.
#include <algorithm>
#include <chrono>
#include <memory>
#include <string>

#include "flat/compile.h"
#include "flat/steps.h"
#include "limn/math/error.h"
#include "math/parallel.h"
#include "scene/shape/arguments.h"

namespace limn::compiler {

namespace {

constexpr std::size_t kGrain = 256;  // objects of one task

// Returns the row of an object in Scene::instances. Throws ArgumentError if it isn't an instance.
std::uint32_t row_of(const flat::Scene& scene, std::size_t object) {
    // Find the numbers of its primitives.
    if (object >= scene.first_of_object.size()) throw ArgumentError("there is no such object");
    const std::uint64_t first = scene.first_of_object[object];
    const bool is_last = object + 1 == scene.first_of_object.size();
    const std::uint64_t end = is_last ? scene.primitives : scene.first_of_object[object + 1];
    // Find its range: the last of those with this first number. The others are empty.
    const std::span ranges = flat::ranges_of(scene, scene.blases.front());
    const auto after = std::ranges::upper_bound(ranges, first, {}, &PrimitiveRange::first_number);
    if (after == ranges.begin() || end == first || (after - 1)->kind != PrimitiveKind::instance ||
        (after - 1)->first_number != first || (after - 1)->count != end - first)
        throw ArgumentError("it is no Instance of something");
    return (after - 1)->first_row;
}

// Restores the arrays of a mesh from the root's tree, which is about to be rebuilt.
void restore_arrays(flat::Scene& scene, flat::Mesh& mesh) {
    struct Arrays {
        std::vector<Float3> vertices;
        std::vector<Index3> triangles;
    };
    const auto arrays = std::make_shared<Arrays>();
    const auto add = [&](const Point3& p) {
        arrays->vertices.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
        return static_cast<std::uint32_t>(arrays->vertices.size() - 1);
    };
    for (std::size_t i = 0; i < mesh.places.size(); ++i) {
        // A triangle without area isn't in the tree; write it with zeros.
        const TriangleVertices v = mesh.places[i] != flat::kNothing ? triangle_of(scene, mesh, i) : TriangleVertices{};
        const std::uint32_t a = add(v.a), b = add(v.b), c = add(v.c);
        arrays->triangles.push_back({a, b, c});
    }
    mesh.arrays.vertices = arrays->vertices;
    mesh.arrays.triangles = arrays->triangles;
    mesh.owner = arrays;
}

// Removes the root's tree and the tables that derive() fills. The arrays of its meshes are restored first.
void drop_what_moves(flat::Scene& scene) {
    // Restore the arrays of meshes.
    for (const PrimitiveRange& range : flat::ranges_of(scene, scene.blases.front())) {
        if (range.kind != PrimitiveKind::mesh) continue;
        flat::Mesh& mesh = scene.meshes[range.first_row];
        if (mesh.arrays.triangles.empty()) restore_arrays(scene, mesh);
    }
    // Cut the tables of trees to their sizes without the root's tree.
    const flat::BelowRoot& below = scene.below_root;
    scene.nodes.resize(below.nodes);
    scene.references.resize(below.references);
    scene.lines.resize(below.lines);
    scene.kinds = static_cast<unsigned>(below.kinds);
    scene.stored_primitives = below.stored_primitives;
    scene.degenerate = below.degenerate;
    // Clear the others.
    scene.list = {};
    scene.media.clear();
    scene.medium_instances.clear();
    scene.media_extent = 0;
    scene.lights = {};
    scene.features = {};
    scene.feature_names.clear();
}

}  // namespace

void move(flat::Scene& scene, std::span<const MovedObject> moved) {
    // Find the instances and check their matrices, before anything is changed.
    const auto start = std::chrono::steady_clock::now();
    std::vector<std::uint32_t> rows(moved.size());
    for_all(0, moved.size(), kGrain, [&](std::size_t i) {
        const MovedObject& m = moved[i];
        try {
            rows[i] = row_of(scene, m.object);
            require_placement(m.world_from_object, m.at_time1.value_or(m.world_from_object), "Instance");
        } catch (const ArgumentError& error) {
            throw ArgumentError("recompile: object " + std::to_string(m.object) + ": " + error.what());
        }
    });
    std::vector<bool> seen(scene.instances.size());
    for (std::size_t i = 0; i < moved.size(); ++i) {
        if (seen[rows[i]])
            throw ArgumentError("recompile: object " + std::to_string(moved[i].object) + " is moved twice");
        seen[rows[i]] = true;
    }
    // Place the instances and rebuild what depends on them.
    drop_what_moves(scene);
    for_all(0, moved.size(), kGrain, [&](std::size_t i) {
        const MovedObject& m = moved[i];
        place_instance(scene.instances[rows[i]], m.world_from_object, m.at_time1.value_or(m.world_from_object));
    });
    build_blas_tree(scene, scene.blases.front());
    derive(scene);
    scene.compile_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace limn::compiler
