// What polygons fill of the sphere of directions, in closed form.
#pragma once

#include <cmath>
#include <vector>

#include "limn/math/vec.h"

namespace limn::test {

/// Van Oosterom and Strackee, The Solid Angle of a Plane Triangle, IEEE Transactions on Biomedical Engineering 30(2),
/// 1983.
inline double solid_angle(const Point3& a, const Point3& b, const Point3& c, const Point3& from) {
    const Vec3 p = normalize(a - from), q = normalize(b - from), r = normalize(c - from);
    return 2 * std::abs(std::atan2(dot(p, cross(q, r)), 1 + dot(p, q) + dot(q, r) + dot(r, p)));
}

/// The integral of the unit direction over all directions towards a polygon of radiance 1, up to its sign: dot with a
/// normal is the irradiance there if the polygon is wholly above. Half the sum over edges of the angle seen times the
/// unit normal of the plane through it (Lambert, Photometria, 1760).
inline Vec3 vector_irradiance(const std::vector<Point3>& corners, const Point3& from) {
    Vec3 sum;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 a = normalize(corners[i] - from), b = normalize(corners[(i + 1) % corners.size()] - from);
        const Vec3 c = cross(a, b);
        sum = sum + std::atan2(length(c), dot(a, b)) * normalize(c);
    }
    return sum / 2;
}

}  // namespace limn::test
