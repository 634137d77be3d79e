// The points of primitives that are nearest to the origin. The caller subtracts the query point from all coordinates,
// and scales them to magnitudes whose fourth powers neither overflow nor underflow.
#pragma once

#include "limn/math/vec.h"

namespace limn {

// The point of a primitive that is nearest to the origin.
struct NearestPoint {
    // The part of a shape that a point is on.
    enum class Part { face, edge_ab, edge_ac, edge_bc, a, b, c };

    Vec3 at;
    // Surface coordinates. On a triangle they are the weights of b and c, on a quad the coordinates along the edges,
    // and on a disk those of exact_disk.h. On a sphere they are 0.
    double u = 0, v = 0;
    Part part = Part::face;
};

// Returns the nearest point of a triangle. It is off by at most 2^-40 of the largest coordinate, however thin the
// triangle is.
NearestPoint nearest_on_triangle(const Vec3& a, const Vec3& b, const Vec3& c);

// Returns the nearest point of a quad. A diagonal divides the quad into two triangles: a, b and c are `corner` and its
// neighbours in one of them, and the opposite corner and its neighbours in the other. `part` is a part of the triangle
// that has the point. A point on the diagonal has the part `face`.
NearestPoint nearest_on_quad(const Vec3& corner, const Vec3& edge_u, const Vec3& edge_v);

// Returns the nearest point of a sphere. It is (radius, 0, 0) if the centre is the origin.
NearestPoint nearest_on_sphere(const Vec3& center, double radius);

// Returns the nearest point of a disk. On the rim, `part` is edge_bc. \pre the normal has unit length
NearestPoint nearest_on_disk(const Vec3& center, const Vec3& normal, double radius);

}  // namespace limn
