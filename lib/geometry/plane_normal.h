// Unit normals of flat shapes. They are accurate for thin and tiny shapes too.
#pragma once

#include "geometry/exact.h"
#include "limn/math/vec.h"

namespace limn {

// Sets the unit normal along cross(u, v) and returns true. In double the cross product is off by about 2^-50 |u| |v|.
// Returns false if this is too much, because the edges are nearly parallel, or if squares could overflow or underflow.
inline bool normalize_cross(const Vec3& u, const Vec3& v, Normal3& normal) {
    const Vec3 n = cross(u, v);
    const double squared = dot(n, n);
    if (!(squared > 1e-200 && squared < 1e200 && max_abs(n) > 0x1p-20 * (max_abs(u) * max_abs(v)))) return false;
    normal = Normal3(n / std::sqrt(squared));
    return true;
}

// Returns the unit normal of a quad, along edge_u x edge_v. \pre !are_parallel(edge_u, edge_v)
inline Normal3 quad_normal(const Vec3& edge_u, const Vec3& edge_v) {
    Normal3 normal;
    return normalize_cross(edge_u, edge_v, normal) ? normal
                                                   : exact_normal(Point3{}, Point3{} + edge_u, Point3{} + edge_v);
}

// Returns the unit normal of a triangle, along (b - a) x (c - a). \pre !are_collinear(a, b, c)
inline Normal3 triangle_normal(const Point3& a, const Point3& b, const Point3& c) {
    Normal3 normal;
    return normalize_cross(b - a, c - a, normal) ? normal : exact_normal(a, b, c);
}

}  // namespace limn
