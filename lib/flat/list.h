// A list of primitives, all of which every ray tests before it traverses the tree. In a small scene the list has all
// primitives, because this is faster than a tree. In other scenes it has the primitives that are so large compared with
// the rest that most rays would test them in the tree anyway.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "limn/math/vec.h"
#include "limn/records/records.h"

namespace limn::flat {

// A planar primitive is packed as its plane and as the coordinates of a point in it (Baldwin, Weber, Fast Ray-Triangle
// Intersections by Coordinate Transformation, JCGT 5(3), 2016):
// - The plane is normal . x = offset. The largest component of `normal` has magnitude 1.
// - The weights of the edges at a point x of the plane are a = u . x - u_offset and b = v . x - v_offset.
// The packed numbers are stored in rows of floats, one number for each primitive in a row.
struct PrimitiveList {
    static constexpr std::size_t kMost = 64, kAlign = 16;

    enum PlanarRow : std::size_t {
        kNormal = 0,
        kOffset = 3,
        kU = 4,
        kUOffset = 7,
        kV = 8,
        kVOffset = 11,
        kSpread = 12,  // 2 max(|u|_1, |v|_1): an error e of each coordinate of x changes a + b by at most kSpread * e
        kPlanarRows = 13
    };
    enum SphereRow : std::size_t { kCenter = 0, kRadius = 3, kSphereRows = 4 };

    // A primitive of the list, in world space.
    struct Entry {
        PrimitiveKind kind = PrimitiveKind::quad;
        bool is_instanced = false;
        std::uint32_t instance = 0;  // row of Scene::instances, if it is instanced
        std::uint32_t row = 0;       // row of the kind's table, or the row of the mesh
        std::uint32_t element = 0;   // the triangle of the mesh
        std::uint64_t number = 0;    // number of the primitive in the scene
        Point3 corner;               // corner of a planar primitive, or centre of a sphere
        Vec3 edge_u, edge_v;
        double radius = 0;  // radius of a sphere, not negative
        double error = 0;   // bounds the rounding error of each coordinate of an instanced primitive
    };

    std::vector<Entry> entries;  // quads first, then triangles, then spheres
    std::uint32_t quads = 0, triangles = 0, spheres = 0;
    std::uint32_t planar_stride = 0, sphere_stride = 0;  // floats of a row, multiples of kAlign
    std::vector<float> planar, round;                    // the rows of planar primitives and spheres
    bool is_all = false;  // true if the list has all primitives; otherwise the root's tree has the others
    float rest_lower[3] = {}, rest_upper[3] = {};  // bounds of the primitives in that tree

    bool empty() const { return entries.empty(); }
    std::uint32_t planars() const { return quads + triangles; }
};

}  // namespace limn::flat
