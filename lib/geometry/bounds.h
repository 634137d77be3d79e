// Bounding boxes of the primitives, for described and compiled scenes. A box contains the shape that the primitive's
// numbers define exactly: every rounding on the way is made up for by rounding outward.
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/hit_error.h"
#include "limn/math/box.h"
#include "limn/math/transform.h"

namespace limn {

// These two return a - b rounded up and rounded down. They compute the rounding error of the difference, which is
// always a double (Knuth, The Art of Computer Programming, vol. 2, section 4.2.2, theorem B).
inline double difference_up(double a, double b) {
    const double difference = a - b, b_seen = a - difference, a_seen = difference + b_seen;
    const double error = (a - a_seen) + (b_seen - b);
    return error > 0 ? std::nextafter(difference, kInfinity) : difference;
}
inline double difference_down(double a, double b) { return -difference_up(b, a); }

// Returns the box of a sphere whose centre moves from center0 to center1 on a straight line.
inline Box sphere_bounds(const Point3& center0, const Point3& center1, double radius) {
    const double r = std::abs(radius);
    Box box;
    for (const Point3& c : {center0, center1})
        for (std::size_t a = 0; a < 3; ++a) {
            box.lower[a] = std::min(box.lower[a], difference_down(c[a], r));
            box.upper[a] = std::max(box.upper[a], difference_up(c[a], -r));
        }
    // The centre between both ends is interpolated with rounding. A centre that does not move is exact.
    const double rounding = center0 == center1 ? 0 : gamma(4) * std::max(max_abs(center0), max_abs(center1));
    return grow(box, along_every_axis(rounding));
}

inline Box quad_bounds(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v) {
    Box box;
    for (const double u : {0.0, 1.0})
        for (const double v : {0.0, 1.0}) box.extend(corner + (u * edge_u + v * edge_v));
    Vec3 rounding;
    for (std::size_t a = 0; a < 3; ++a)
        rounding[a] = gamma(3) * (std::abs(corner[a]) + std::abs(edge_u[a]) + std::abs(edge_v[a]));
    const Box grown = grow(box, rounding);
    // Along an axis that both edges are perpendicular to, every point has exactly the corner's coordinate.
    for (std::size_t a = 0; a < 3; ++a) {
        const bool flat = edge_u[a] == 0 && edge_v[a] == 0;
        box.lower[a] = flat ? corner[a] : grown.lower[a];
        box.upper[a] = flat ? corner[a] : grown.upper[a];
    }
    return box;
}

// Returns the box of a moving instance. Its points move on straight lines. Therefore the union of the boxes at both
// ends contains all boxes between, except for the rounding of the interpolation, by which it is grown.
inline Box instance_bounds(const Transform& at_time0, const Transform& at_time1, const Box& object) {
    const Box box = transform_box(at_time0, object);
    if (at_time0 == at_time1 || box.is_empty()) return box;
    const Box both = merge(box, transform_box(at_time1, object));
    return grow(both, along_every_axis(gamma(8) * std::max(max_abs(both.lower), max_abs(both.upper))));
}

}  // namespace limn
