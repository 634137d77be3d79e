// Ray against triangle and parallelogram, one definition for the described and the compiled world.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "limn/core/ray.h"
#include "limn/core/vec.h"

namespace limn {

// A ray with the axes permuted so that its direction is largest along z. Shearing by it maps the direction onto z, so
// that a triangle is hit where the origin lies inside its projection. An edge that two triangles share is decided by
// the same number for both, but for its sign: no ray passes between them. Woop, Benthin, Wald, Watertight Ray/Triangle
// Intersection, JCGT 2(1), 2013; here in double.
struct ShearedRay {
    std::size_t x, y, z;
    double shear_x, shear_y;
    double direction_z;
    Point3 origin;

    explicit ShearedRay(const Ray& ray) : origin(ray.origin) {
        const Vec3 d = abs(ray.direction);
        z = d.x > d.y ? (d.x > d.z ? 0 : 2) : (d.y > d.z ? 1 : 2);
        x = z == 2 ? 0 : z + 1;
        y = x == 2 ? 0 : x + 1;
        direction_z = ray.direction[z];
        shear_x = ray.direction[x] / direction_z;
        shear_y = ray.direction[y] / direction_z;
    }
    // z is left as it is: dividing by direction_z turns it into t.
    Vec3 shear(const Vec3& v) const { return {v[x] - shear_x * v[z], v[y] - shear_y * v[z], v[z]}; }
};

struct PlanarHit {
    double t, u, v;
};

// u and v are the weights of b and c. A zero edge value is inside; a ray in the plane (zero area seen) misses.
inline bool intersect_triangle(const Point3& a, const Point3& b, const Point3& c, const ShearedRay& ray, double t_min,
                               double t_max, PlanarHit& hit) {
    const Vec3 pa = ray.shear(a - ray.origin), pb = ray.shear(b - ray.origin), pc = ray.shear(c - ray.origin);
    const double wa = pc.x * pb.y - pc.y * pb.x;
    const double wb = pa.x * pc.y - pa.y * pc.x;
    const double wc = pb.x * pa.y - pb.y * pa.x;
    if ((wa < 0 || wb < 0 || wc < 0) && (wa > 0 || wb > 0 || wc > 0)) return false;
    const double det = wa + wb + wc;
    if (!(std::abs(det) > 0)) return false;
    const double t = (wa * pa.z + wb * pb.z + wc * pc.z) / det / ray.direction_z;
    if (!(t > t_min && t <= t_max && t < kInfinity)) return false;
    hit = {t, wb / det, wc / det};
    return true;
}

// Solves corner + u edge_u + v edge_v = origin in the sheared plane by Cramer's rule. Quads that meet share no numbers
// of which an edge test could make the same decision twice, so a quad is closed by the rounding of its test: each
// sheared coordinate is at most 2 M with an error of 6 M u, M being the largest coordinate that went into it; the
// difference of two products of them is off by at most 64 u M M', u = 2^-53.
inline bool intersect_quad(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const ShearedRay& ray,
                           double t_min, double t_max, PlanarHit& hit) {
    const Vec3 q = ray.shear(corner - ray.origin), eu = ray.shear(edge_u), ev = ray.shear(edge_v);
    double det = eu.x * ev.y - eu.y * ev.x;
    double wu = ev.x * q.y - ev.y * q.x;
    double wv = q.x * eu.y - q.y * eu.x;
    if (det < 0) det = -det, wu = -wu, wv = -wv;
    const double reach = gamma(64) * max_abs(corner - ray.origin);
    const double slack_u = reach * max_abs(edge_v), slack_v = reach * max_abs(edge_u);
    if (!(wu >= -slack_u && wu <= det + slack_u && wv >= -slack_v && wv <= det + slack_v && det > 0)) return false;
    const double u = std::clamp(wu / det, 0.0, 1.0), v = std::clamp(wv / det, 0.0, 1.0);
    const double t = (q.z + u * eu.z + v * ev.z) / ray.direction_z;
    if (!(t > t_min && t <= t_max && t < kInfinity)) return false;
    hit = {t, u, v};
    return true;
}

inline Point3 to_point(const Float3& p) { return {p.x, p.y, p.z}; }
inline Vec3 to_vec(const Float3& v) { return {v.x, v.y, v.z}; }

// The vertices of a mesh triangle are float32: differences in double are exact but for far-apart magnitudes.
inline Normal3 triangle_normal(const Point3& a, const Point3& b, const Point3& c) {
    return Normal3(unit_cross(b - a, c - a));
}

}  // namespace limn
