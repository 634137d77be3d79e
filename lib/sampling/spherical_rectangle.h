// A rectangle as seen from a point: its solid angle, and directions uniform in it. Urena, Fajardo, King, An
// Area-Preserving Parametrization for Spherical Rectangles, EGSR 2013; symbols as there.
#pragma once

#include "limn/core/vec.h"

namespace limn::sampling {

class SphericalRectangle {
public:
    // \pre the edges are perpendicular
    SphericalRectangle(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const Point3& from);

    // In steradians; 0 where `from` lies in the rectangle's plane.
    double solid_angle() const { return solid_angle_; }

    // A point of the rectangle whose direction from `from` is uniform per solid angle, as weights of the two edges.
    // \pre solid_angle() > 0
    Uv sample(double u, double v) const;

private:
    double x0_, x1_, y0_, y1_, z0_;  // corners relative to `from`; the rectangle's plane is z = z0 < 0
    double b0_, b1_, k_, solid_angle_;
};

}  // namespace limn::sampling
