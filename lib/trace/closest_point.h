// The nearest point of all surfaces, by a walk through the trees that rays walk through, nearer boxes first.
#pragma once

#include "flat/scene.h"
#include "geometry/closest_point.h"

namespace limn::trace {

struct NearestSurface {
    double distance = kInfinity;  // kInfinity: none within the search
    Point3 position;
    NearestPoint point;
    std::uint64_t primitive = flat::RawHit::kMiss;
};

// \pre the point is finite. \throws ArgumentError at a round shape in an instance that turns it into another
NearestSurface closest_point(const flat::Scene& scene, const Point3& point, double max_distance, double time);

}  // namespace limn::trace
