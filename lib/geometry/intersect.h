// Intersections of rays with described shapes. Compiled shapes use the same filters and the same exact fallback.
#pragma once

#include <cstddef>

#include "geometry/exact.h"
#include "geometry/filter.h"
#include "geometry/ray_frame.h"
#include "limn/math/mesh_view.h"
#include "limn/math/vec.h"

namespace limn {

// These return true if the ray hits the closed shape and t is within the search. This decision is exact. If true, t, u
// and v are set, as accurate as kAccurate and kAccurateWeight demand.
bool intersect_triangle(const Point3& a, const Point3& b, const Point3& c, const RayFrame& frame, const Search& search,
                        PlanarHit& hit);
bool intersect_quad(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const RayFrame& frame,
                    const Search& search, PlanarHit& hit);
// Returns the index of the nearest triangle of a mesh, the first of several with the same t. Returns the number of
// triangles if none is hit.
std::size_t intersect_mesh(const MeshView& mesh, const RayFrame& frame, const Search& search, PlanarHit& hit);
// The hit is at the first root that is within the search. \pre radius > 0
bool intersect_sphere(const Point3& center, double radius, const RayFrame& frame, const Search& search, PlanarHit& hit);

}  // namespace limn
