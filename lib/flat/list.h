// Primitives that are tested one and all: those of a scene of a few, which is sooner done than walking through a tree,
// and those that are so large beside the others that most rays would come upon them in the tree.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "limn/core/vec.h"
#include "limn/records.h"

namespace limn::flat {

// Planar primitives are packed as their plane and their own coordinates in it: normal . x = offset, of which the
// largest coordinate is 1, and of a point of the plane the weights of the edges, a = u . x - u_offset, b = v . x -
// v_offset (Baldwin, Weber, Fast Ray-Triangle Intersections by Coordinate Transformation, JCGT 5(3), 2016). Rows of
// floats, each as long as `stride`; quads stand before triangles.
struct PrimitiveList {
    static constexpr std::size_t kMost = 64, kAlign = 16;

    enum PlanarRow : std::size_t {
        kNormal = 0,
        kOffset = 3,
        kU = 4,
        kUOffset = 7,
        kV = 8,
        kVOffset = 11,
        kSpread = 12,  // twice the larger sum of the magnitudes of u and of v: what an error of x does to a + b
        kPlanarRows = 13
    };
    enum SphereRow : std::size_t { kCenter = 0, kRadius = 3, kSphereRows = 4 };

    // As the world sees it. Planar: corner and edges; sphere: centre.
    struct Entry {
        PrimitiveKind kind = PrimitiveKind::quad;
        bool is_instanced = false;
        std::uint32_t instance = 0;  // if it is
        std::uint32_t row = 0;       // of its table, the mesh's for triangles of meshes
        std::uint32_t element = 0;   // of the mesh
        std::uint64_t number = 0;
        Point3 corner;
        Vec3 edge_u, edge_v;
        double radius = 0;
        double error = 0;  // bound on that of each coordinate of corner and edges: of instances
    };

    std::vector<Entry> entries;  // quads, triangles, spheres
    std::uint32_t quads = 0, triangles = 0, spheres = 0;
    std::uint32_t planar_stride = 0, sphere_stride = 0;
    std::vector<float> planar, round;
    bool is_all = false;  // else there are more in the root's tree, where those that are listed do not stand
    float rest_lower[3] = {}, rest_upper[3] = {};  // of what is in that tree

    bool empty() const { return entries.empty(); }
    std::uint32_t planars() const { return quads + triangles; }
};

}  // namespace limn::flat
