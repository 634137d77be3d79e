// Passages of rays through surfaces, by a rule that decides every case: Edelsbrunner, Muecke, Simulation of Simplicity,
// ACM TOG 9(1), 1990.
//
// The ray is treated as if it were moved by the vector (e, e^2, e^3), where e > 0 is smaller than any positive number.
// Its direction is unchanged. Its ends at t_min and t_max move with it. A passage is an intersection of the moved ray,
// between its ends, with a surface. In this position
//   - the ray intersects no edge and no vertex, and it is in the plane of no face;
//   - its ends are on no surface;
//   - therefore the signs of its passages through a closed surface add up to the difference of the winding numbers at
//     its ends.
//
// Every decision is the sign of a polynomial in the given coordinates and in e. Its value for the given ray decides if
// it is not 0. Otherwise its slope decides, the derivative with respect to the move: the sign of the first coordinate
// of the slope that is not 0.
//   - The polynomials of flat shapes are linear in the move.
//   - The sign for an edge is the same for all faces that share it. Therefore they agree on which side the ray passes.
//   - A ray that touches a sphere misses it. If an end of the ray is on a sphere, the slope decides.
//
// The move is a vector in world space. Inside an instance it is transformed.
#pragma once

#include "geometry/exact.h"
#include "geometry/filter.h"
#include "geometry/ray_frame.h"

namespace limn {

// An intersection of the moved ray with a surface. t, u and v are those of the given ray. Therefore t may be equal to
// an end of the ray, or beyond it by rounding.
struct Passage : PlanarHit {
    bool inward;  // true if the ray goes against the outward normal
};

// These two return true if the moved ray passes through a triangle or quad, and set `passage`. All decisions are exact.
bool exact_passage(const Point3& a, const Point3& b, const Point3& c, const RayFrame& frame, const Search& search,
                   Passage& passage);
bool exact_passage(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const RayFrame& frame,
                   const Search& search, Passage& passage);
// Sets the passages through a sphere in their order along the ray, and returns their number: 0, 1 or 2. If `radius` is
// negative, the outward normal points to the centre. \pre radius is not 0
int exact_passages(const Point3& center, double radius, const RayFrame& frame, const Search& search,
                   Passage (&passages)[2]);

// These two return the exact sign of n.d, where n is the outward normal and d the direction of the ray.
int exact_facing(const Point3& a, const Point3& b, const Point3& c, const RayFrame& frame);
int exact_facing(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const RayFrame& frame);

// These return true if the origin of the ray is exactly on the closed shape.
bool is_origin_on(const Point3& a, const Point3& b, const Point3& c, const RayFrame& frame);
bool is_origin_on(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const RayFrame& frame);
bool is_origin_on(const Point3& center, double radius, const RayFrame& frame);

// Returns the sign of n.d, where n = u x v and d is the direction of the ray. Returns 0 if double precision cannot
// prove the sign. The edges u and v may be off by a rounding.
//
// Let U, V and D be the largest magnitudes of the coordinates of u, v and d. In units of kRoundoff
//   - each coordinate of n is off by 8 U V: 4 from the edges, 2 from its two products, 2 from their difference;
//   - its product with a coordinate of d is off by 10 U V D, because the product is at most 2 U V D;
//   - the sum of three such products is off by 42 U V D.
// A direction that is off by s along each axis adds 6 s U V.
inline int facing(const Vec3& u, const Vec3& v, const RayFrame& frame) {
    const double edges = max_abs(u) * max_abs(v), along = max_abs(frame.ray.direction);
    const double product = dot(cross(u, v), frame.ray.direction);
    const double error = edges * (64 * kRoundoff * along + 7 * frame.direction_error) + 0x1p-900;
    return product > error ? 1 : product < -error ? -1 : 0;
}

}  // namespace limn
