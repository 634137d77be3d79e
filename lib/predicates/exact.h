// The last stage of the intersections: exact arithmetic on the numbers that define shape and ray, for what the filters
// leave undecided. About a microsecond each.
#pragma once

#include "predicates/filter.h"
#include "predicates/ray_frame.h"

namespace limn {

// Whether the shape is hit within the search; t, u and v rounded (ratio).
bool exact_triangle(const Point3& a, const Point3& b, const Point3& c, const RayFrame& frame, const Search& search,
                    PlanarHit& hit);
bool exact_quad(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const RayFrame& frame,
                const Search& search, PlanarHit& hit);

// The roots of a sphere within a search, near <= far.
struct SphereHits {
    bool near_found = false, far_found = false;
    double near = 0, far = 0;
};

// `near`, `far`: what the filter found, where that is accurate; else null.
SphereHits exact_sphere(const Point3& center, double radius, const RayFrame& frame, const double* near,
                        const double* far, const Search& search);

// Whether u and v are exactly parallel, or one is zero.
bool are_parallel(const Vec3& u, const Vec3& v);
// Whether the points lie exactly on a line.
bool are_collinear(const Point3& a, const Point3& b, const Point3& c);
// The unit vector along (b - a) x (c - a), right to the last places however thin the triangle. \pre not collinear
Normal3 exact_normal(const Point3& a, const Point3& b, const Point3& c);

}  // namespace limn
