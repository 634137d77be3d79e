// A triangle as seen from a point: its solid angle, and directions uniform in it. After Arvo, Stratified Sampling of
// Spherical Triangles, SIGGRAPH 1995, with the solid angle of Van Oosterom and Strackee, IEEE Transactions on
// Biomedical Engineering 30(2), 1983.
#pragma once

#include "limn/core/vec.h"

namespace limn::sampling {

class SphericalTriangle {
public:
    // Unit vectors towards the corners, no two of them opposite.
    SphericalTriangle(const Vec3& a, const Vec3& b, const Vec3& c);

    // In steradians; 0 where the corners are on a great circle.
    double solid_angle() const { return solid_angle_; }

    // A unit vector, uniform per solid angle: an arc that turns around b from a to c has passed the share u of it, and
    // v says how far along the arc. \pre solid_angle() > 0
    Vec3 sample(double u, double v) const;

private:
    Vec3 a_, b_, c_;
    double cos_c_;   // of the side from a to b
    double volume_;  // |a . (b x c)|
    double solid_angle_;
};

}  // namespace limn::sampling
