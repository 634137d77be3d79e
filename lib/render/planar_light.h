// Points on flat emitters, drawn as the receiver sees them.
#pragma once

#include <optional>

#include "flat/lights.h"
#include "limn/core/vec.h"

namespace limn::transport {

struct PlanarSample {
    Uv weights;  // of the light's two edges
    Point3 position;
    Vec3 normal;     // of any length
    double pdf = 0;  // per solid angle
};

// Uniform per solid angle where the light is near; from afar, or almost edge-on, uniform per area, which is as good
// there and costs less. Nothing where it is seen edge-on.
std::optional<PlanarSample> sample_planar(const flat::Light& light, const Point3& from, double u, double v);

// With which density sample_planar draws the way to a point of the light; 0 where it never does.
double pdf_planar(const flat::Light& light, const Point3& from, const Vec3& way);

}  // namespace limn::transport
