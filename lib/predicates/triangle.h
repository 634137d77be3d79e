// Ray against triangle, one definition for the described and the compiled world.
#pragma once

#include "predicates/exact.h"
#include "predicates/sheared_ray.h"

namespace limn {

// The filter: hit, miss or unsure. u and v are the weights of b and c. A point of an edge belongs to the triangle, a
// ray in its plane misses.
//
// The edge values w are determinants of sheared vertices, off by at most e (sheared_ray.h). If all three lie beyond e
// on the same side, the ray passes through the inside; if two lie beyond it on different sides, it passes by.
//
// The weights w / (wa + wb + wc) are off by at most 5 e / |wa + wb + wc|: e from w, 3 e from the sum, whose own two
// roundings are less than e. As computed they add up to 1, so that in the mean z only differences of z see that error,
// those of two vertices to the third.
inline PlanarAnswer filter_triangle(const Point3& a, const Point3& b, const Point3& c, const ShearedRay& ray,
                                    const Search& search) {
    const Vec3 qa = a - ray.origin, qb = b - ray.origin, qc = c - ray.origin;
    const Vec3 pa = ray.shear(qa), pb = ray.shear(qb), pc = ray.shear(qc);
    const double wa = pc.x * pb.y - pc.y * pb.x;
    const double wb = pa.x * pc.y - pa.y * pc.x;
    const double wc = pb.x * pa.y - pb.y * pa.x;
    const double least = smaller(wa, smaller(wb, wc)), most = larger(wa, larger(wb, wc));
    if (least < -ray.coarse && most > ray.coarse) return {Decision::miss};
    const double reach = larger(largest_magnitude(qa.x, qa.y, qa.z),
                                larger(largest_magnitude(qb.x, qb.y, qb.z), largest_magnitude(qc.x, qc.y, qc.z)));
    const double across = larger(largest_magnitude(pa.x, pb.x, pc.x), largest_magnitude(pa.y, pb.y, pc.y));
    const double e = ray.determinant_error(reach, across);
    if (least < -e && most > e) return {Decision::miss};
    if (!(least > e || most < -e)) return {Decision::undecided};

    const double det = wa + wb + wc;
    const double depth = larger(pa.z, larger(pb.z, pc.z)) - smaller(pa.z, smaller(pb.z, pc.z));
    const double z = (wa * pa.z + wb * pb.z + wc * pc.z) / det;
    const PlanarAnswer answer =
        planar_answer(ray, ray.coordinate_error(reach), 5 * e / std::abs(det), depth, z, wb / det, wc / det, search);
    if (answer.decision == Decision::undecided && search.t_min >= 0) {
        const bool turned = (det < 0) == (ray.direction_z < 0);  // the normal, against the ray
        if (is_beyond(ray, b - a, c - a, qa, turned, search.t_max)) return {Decision::miss};
        const Vec3 ab = qb - qa, ac = qc - qa;
        const double edge = larger(max_abs(ab), max_abs(ac)), edge_error = kRoundoff * (2 * reach + edge);
        if (is_behind(ray, dot(cross(ab, ac), qa), turned, edge, edge_error, max_abs(qa))) return {Decision::miss};
    }
    return answer;
}

// Exact: whether the closed triangle is hit, and t within the search. t, u, v as kAccurate says.
inline bool intersect_triangle(const Point3& a, const Point3& b, const Point3& c, const ShearedRay& ray,
                               const Search& search, PlanarHit& hit) {
    const PlanarAnswer answer = filter_triangle(a, b, c, ray, search);
    hit = answer.hit;
    if (answer.decision != Decision::undecided) return answer.decision == Decision::hit;
    return exact_triangle(a, b, c, *ray.frame, search, hit);
}

}  // namespace limn
