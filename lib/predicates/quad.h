// Ray against parallelogram, one definition for the described and the compiled world.
#pragma once

#include "predicates/exact.h"
#include "predicates/sheared_ray.h"

namespace limn {

// The filter. Solves corner + u edge_u + v edge_v = origin in the sheared plane by Cramer's rule: u = wu / det, v = wv
// / det. All three determinants are off by at most e (sheared_ray.h), det - w by 3 e with its own rounding. The border
// belongs to the quad, a ray in its plane misses. A ray can only hit if |w| <= |det|, which tells rays along the plane
// apart from those in it.
//
// u and v are off by at most 4 e / |det|; z changes by at most |edge_u.z| + |edge_v.z| over the quad.
inline PlanarAnswer filter_quad(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const ShearedRay& ray,
                                const Search& search) {
    const Vec3 to_corner = corner - ray.origin;
    const Vec3 q = ray.shear(to_corner), eu = ray.shear(edge_u), ev = ray.shear(edge_v);
    double det = eu.x * ev.y - eu.y * ev.x;
    double wu = ev.x * q.y - ev.y * q.x;
    double wv = q.x * eu.y - q.y * eu.x;
    const bool turned = det < 0;
    if (turned) det = -det, wu = -wu, wv = -wv;
    const double least = smaller(wu, wv), most = larger(wu, wv);
    const auto is_missed = [&](double e) { return larger(-least, most) > det + 3 * e || (det > e && least < -e); };
    if (is_missed(ray.coarse)) return {Decision::miss};
    const double reach = larger(
        largest_magnitude(to_corner.x, to_corner.y, to_corner.z),
        larger(largest_magnitude(edge_u.x, edge_u.y, edge_u.z), largest_magnitude(edge_v.x, edge_v.y, edge_v.z)));
    const double across = larger(largest_magnitude(q.x, eu.x, ev.x), largest_magnitude(q.y, eu.y, ev.y));
    const double e = ray.determinant_error(reach, across);
    if (is_missed(e)) return {Decision::miss};
    if (!(least > e && det - most > 3 * e)) return {Decision::undecided};

    const double u = wu / det, v = wv / det;
    const double z = q.z + (u * eu.z + v * ev.z);
    const PlanarAnswer answer =
        planar_answer(ray, ray.coordinate_error(reach), 4 * e / det, std::abs(eu.z) + std::abs(ev.z), z, u, v, search);
    if (answer.decision == Decision::undecided && search.t_min >= 0) {
        const bool against = turned != (ray.direction_z < 0);
        const double edge = larger(max_abs(edge_u), max_abs(edge_v));
        if (is_behind(ray, dot(cross(edge_u, edge_v), to_corner), against, edge, 0, max_abs(to_corner)) ||
            is_beyond(ray, edge_u, edge_v, to_corner, against, search.t_max))
            return {Decision::miss};
    }
    return answer;
}

// Exact: whether the closed parallelogram is hit, and t within the search. t, u, v as kAccurate says.
inline bool intersect_quad(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const ShearedRay& ray,
                           const Search& search, PlanarHit& hit) {
    const PlanarAnswer answer = filter_quad(corner, edge_u, edge_v, ray, search);
    hit = answer.hit;
    if (answer.decision != Decision::undecided) return answer.decision == Decision::hit;
    return exact_quad(corner, edge_u, edge_v, *ray.frame, search, hit);
}

}  // namespace limn
