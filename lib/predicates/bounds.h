// Bounds of the primitives, one definition for the described and the compiled world. Each contains the shape that its
// numbers define exactly: what was rounded on the way is rounded outward.
#pragma once

#include <algorithm>
#include <cmath>

#include "limn/core/box.h"
#include "limn/core/transform.h"
#include "predicates/hit_error.h"

namespace limn {

// a - b rounded up, and rounded down. The error of a sum is exact in double: Knuth, The Art of Computer Programming,
// vol. 2, section 4.2.2, theorem B.
inline double difference_up(double a, double b) {
    const double difference = a - b, b_seen = a - difference, a_seen = difference + b_seen;
    const double error = (a - a_seen) + (b_seen - b);
    return error > 0 ? std::nextafter(difference, kInfinity) : difference;
}
inline double difference_down(double a, double b) { return -difference_up(b, a); }

inline Box sphere_bounds(const Point3& center0, const Point3& center1, double radius) {
    const double r = std::abs(radius);
    Box box;
    for (const Point3& c : {center0, center1})
        for (std::size_t a = 0; a < 3; ++a) {
            box.lower[a] = std::min(box.lower[a], difference_down(c[a], r));
            box.upper[a] = std::max(box.upper[a], difference_up(c[a], -r));
        }
    // A moving centre is rounded on its way; a still one is where it is.
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
    for (std::size_t a = 0; a < 3; ++a) {  // where the quad is flat it has the corner's own coordinate, exactly
        const bool flat = edge_u[a] == 0 && edge_v[a] == 0;
        box.lower[a] = flat ? corner[a] : grown.lower[a];
        box.upper[a] = flat ? corner[a] : grown.upper[a];
    }
    return box;
}

// Points of a moving instance go on straight lines, so the boxes at both ends enclose all between, but for the rounding
// of the interpolation.
inline Box instance_bounds(const Transform& at_time0, const Transform& at_time1, const Box& object) {
    const Box box = transform_box(at_time0, object);
    if (at_time0 == at_time1 || box.is_empty()) return box;
    const Box both = merge(box, transform_box(at_time1, object));
    return grow(both, along_every_axis(gamma(8) * std::max(max_abs(both.lower), max_abs(both.upper))));
}

}  // namespace limn
