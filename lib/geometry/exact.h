// The last stage of the intersections: exact arithmetic on the numbers that define shape and ray. It is used if the
// filters cannot decide. One call takes about a microsecond.
#pragma once

#include "geometry/filter.h"
#include "geometry/ray_frame.h"

namespace limn {

// These two return true if the ray hits the closed shape and t is within the search; then `hit` is set. t, u and v are
// exact up to the rounding of ratio(). The rounded t is compared with the search.
bool exact_triangle(const Point3& a, const Point3& b, const Point3& c, const RayFrame& frame, const Search& search,
                    PlanarHit& hit);
bool exact_quad(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const RayFrame& frame,
                const Search& search, PlanarHit& hit);

// The roots of a sphere, near <= far, and which of them are within a search.
struct SphereHits {
    bool near_found = false, far_found = false;
    double near = 0, far = 0;
};

// Returns the roots of a sphere. `near` and `far` are the roots that the filter found if they are accurate, else null.
// A root that is given is returned unchanged. The sign of `radius` does not count. \pre *near <= *far if both are given
SphereHits exact_sphere(const Point3& center, double radius, const RayFrame& frame, const double* near,
                        const double* far, const Search& search);

// Returns true if u and v are exactly parallel or one of them is zero.
bool are_parallel(const Vec3& u, const Vec3& v);
// Returns true if the points are exactly on a line.
bool are_collinear(const Point3& a, const Point3& b, const Point3& c);
// Returns the unit vector along (b - a) x (c - a). It is correct to the last places however thin the triangle is. \pre
// the points are not collinear
Normal3 exact_normal(const Point3& a, const Point3& b, const Point3& c);

}  // namespace limn
