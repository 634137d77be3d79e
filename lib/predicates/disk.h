// Ray against disk, exactly: the points of the plane through `center` across `normal`, as far as `radius` from it.
#pragma once

#include "limn/core/box.h"
#include "limn/core/vec.h"
#include "predicates/filter.h"
#include "predicates/ray_frame.h"

namespace limn {

// Whether the closed disk is hit, and t within the search, as kAccurate says. u and v go from 0 to 1 over the square
// around it, along the tangents of Frame(normal). \pre radius > 0, and the normal is not zero
bool intersect_disk(const Point3& center, const Vec3& normal, double radius, const RayFrame& frame,
                    const Search& search, PlanarHit& hit);

// The same without a filter. Where the disk is hit, `hit` is set even if t is not within the search.
bool exact_disk(const Point3& center, const Vec3& normal, double radius, const RayFrame& frame, const Search& search,
                PlanarHit& hit);

Box disk_bounds(const Point3& center, const Vec3& normal, double radius);

}  // namespace limn
