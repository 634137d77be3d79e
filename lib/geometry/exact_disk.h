// Exact intersection of rays with disks. A disk consists of the points at most `radius` away from `center` in the plane
// through `center` that is perpendicular to `normal`.
#pragma once

#include "geometry/filter.h"
#include "geometry/ray_frame.h"
#include "limn/math/box.h"
#include "limn/math/vec.h"

namespace limn {

// Returns true if the ray hits the disk, including its rim, and t is within the search. Then sets `hit`, as accurate as
// kAccurate and kAccurateWeight demand. u and v go from 0 to 1 over the square around the disk, along x and y of
// Frame(normal). A ray in the plane of the disk misses. \pre radius > 0, and the normal is not zero
bool intersect_disk(const Point3& center, const Vec3& normal, double radius, const RayFrame& frame,
                    const Search& search, PlanarHit& hit);

// Returns the same, computed in exact arithmetic only. If the line of the ray intersects the disk, `hit` is set even if
// t is not within the search.
bool exact_disk(const Point3& center, const Vec3& normal, double radius, const RayFrame& frame, const Search& search,
                PlanarHit& hit);

// Returns a box that contains the disk.
Box disk_bounds(const Point3& center, const Vec3& normal, double radius);

}  // namespace limn
