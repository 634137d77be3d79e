// Rays against the shapes as they are described: the same filters and the same exact fallback as for compiled ones.
#pragma once

#include <cstddef>

#include "limn/core/mesh_view.h"
#include "limn/core/vec.h"
#include "predicates/exact.h"
#include "predicates/filter.h"
#include "predicates/ray_frame.h"

namespace limn {

// Exact: whether the closed shape is hit, and t within the search. t, u, v as kAccurate says.
bool intersect_triangle(const Point3& a, const Point3& b, const Point3& c, const RayFrame& frame, const Search& search,
                        PlanarHit& hit);
bool intersect_quad(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const RayFrame& frame,
                    const Search& search, PlanarHit& hit);
// The nearest triangle of a mesh, of equally near ones the first; how many there are if none is hit.
std::size_t intersect_mesh(const MeshView& mesh, const RayFrame& frame, const Search& search, PlanarHit& hit);
// The first root. \pre radius > 0
bool intersect_sphere(const Point3& center, double radius, const RayFrame& frame, const Search& search, PlanarHit& hit);

}  // namespace limn
