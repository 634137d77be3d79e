// The points of primitives that are nearest to the origin. Coordinates are seen from there, and of a size whose fourth
// powers are doubles.
#pragma once

#include "limn/core/vec.h"

namespace limn {

struct NearestPoint {
    enum class Part { face, edge_ab, edge_ac, edge_bc, a, b, c };

    Vec3 at;
    double u = 0, v = 0;  // of triangles the weights of b and c
    Part part = Part::face;
};

// Off by no more than 2^-40 of the largest coordinate, however thin the triangle is.
NearestPoint nearest_on_triangle(const Vec3& a, const Vec3& b, const Vec3& c);

// u and v along the edges; the parts are those of its halves that meet in the diagonal, which is no edge.
NearestPoint nearest_on_quad(const Vec3& corner, const Vec3& edge_u, const Vec3& edge_v);

NearestPoint nearest_on_sphere(const Vec3& center, double radius);

// Its rim is edge_bc. u and v as intersect_disk has them. \pre the normal has unit length
NearestPoint nearest_on_disk(const Vec3& center, const Vec3& normal, double radius);

}  // namespace limn
