// Bounds of what a plane leaves of a triangle on both its sides, for the spatial splits of a tree.
#pragma once

#include "accel/build_primitive.h"

namespace limn::accel {

// See Clip::cut. No point of the triangle that is in `box` and on a side of the plane is outside of that side's part.
// \pre no coordinate is beyond 2^125
//
// What is on one side is the convex hull of the vertices there and of the points where edges cross the plane, so its
// bounds are the bounds of those. Vertices and the plane are exact. A crossing q of the edge from a to b is computed as
// a + t (b - a), t = (position - a_axis) / (b_axis - a_axis), 0 <= t <= 1. With u = 2^-24, both differences, the
// quotient, b - a and the product lose u of themselves at most: 6 u |b - a| together. The sum, and widening the bounds,
// lose u of less than 1.01 m each, with m the larger of |a| and |b|; and where a result is subnormal, 2^-150 |b - a| or
// 2^-150. The bounds are wider by 8 u |b - a| + 4 u m + 2^-146, which is more than all these with the rounding of its
// own three products and sums, of 4 u of it. As q lies between a and b, so may its bounds.
inline Clip::Parts clip_triangle(const float (&vertices)[3][3], const FloatBox& box, int axis, float position) {
    const auto vertex = [&](int i) { return Vec4{vertices[i][0], vertices[i][1], vertices[i][2]}; };
    const auto magnitude = [](Vec4 v) { return max(v, -v); };
    const Vec4 corners[3] = {vertex(0), vertex(1), vertex(2)}, plane = splat(position);
    const Int4 on_axis = Int4{0, 1, 2, 3} == Int4{axis, axis, axis, axis};
    Bounds lower = kEmpty, upper = kEmpty;
    for (int i = 0; i < 3; ++i) {
        const Vec4 a = corners[i], b = corners[(i + 1) % 3];
        const Vec4 a_axis = splat(a[axis]), b_axis = splat(b[axis]);
        lower.extend({a_axis <= plane ? a : kEndless, a_axis <= plane ? a : -kEndless});
        upper.extend({a_axis >= plane ? a : kEndless, a_axis >= plane ? a : -kEndless});
        const Vec4 edge = b - a, crossing = a + (plane - a_axis) / (b_axis - a_axis) * edge;
        const Vec4 wider =
            splat(0x1p-21f) * magnitude(edge) + splat(0x1p-22f) * max(magnitude(a), magnitude(b)) + splat(0x1p-146f);
        const Vec4 low = on_axis ? plane : max(crossing - wider, min(a, b));
        const Vec4 high = on_axis ? plane : min(crossing + wider, max(a, b));
        const Int4 crosses = (min(a_axis, b_axis) < plane) & (plane < max(a_axis, b_axis));
        const Bounds there{crosses ? low : kEndless, crosses ? high : -kEndless};
        lower.extend(there);
        upper.extend(there);
    }
    const Bounds inside = to_bounds(box);
    return {to_box({max(lower.lower, inside.lower), min(lower.upper, inside.upper)}),
            to_box({max(upper.lower, inside.lower), min(upper.upper, inside.upper)})};
}

}  // namespace limn::accel
