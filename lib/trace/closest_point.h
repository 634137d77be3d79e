// Finds the nearest point of all surfaces. It walks through the trees that rays walk through, the nearest boxes first.
#pragma once

#include "flat/scene.h"
#include "geometry/closest_point.h"

namespace limn::trace {

// The result of closest_point().
struct NearestSurface {
    double distance = kInfinity;  // infinite if there is no surface within the search
    Point3 position;
    NearestPoint point;
    std::uint64_t primitive = flat::RawHit::kMiss;
};

// Returns the surface point nearest to `point` up to max_distance. \pre the point is finite
// \throws ArgumentError if a round shape is in an instance that scales it unevenly
NearestSurface closest_point(const flat::Scene& scene, const Point3& point, double max_distance, double time);

}  // namespace limn::trace
