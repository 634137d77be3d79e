// Where rays pass through surfaces, by a rule that decides every case (Edelsbrunner, Muecke, Simulation of Simplicity,
// ACM TOG 9(1), 1990).
//
// A ray counts as moved by (e, e^2, e^3), e > 0 and smaller than any number; its direction stays. The moved ray meets
// no edge and no vertex, lies in no plane of a face, and its ends t_min and t_max, which move along, lie on no surface.
// So it passes through a closed surface as often as its ends say, whose winding numbers differ by the sum of the
// passages' signs. Every decision is the sign of a polynomial in the coordinates as they were given and in e: that
// of the value where it is not zero, else of the first coordinate of its slope that is not. Flat shapes' are linear in
// the move. A sphere is missed by a ray that touches it, and an end on it is decided by the slope.
// An edge's sign is the same for all faces that share it, so that they agree where the ray passes.
//
// The move is that of the world. Instances see its image.
#pragma once

#include "predicates/exact.h"
#include "predicates/filter.h"
#include "predicates/ray_frame.h"

namespace limn {

// t, u and v are those of the ray where it was given; t may lie at an end, or beyond it by rounding.
struct Passage : PlanarHit {
    bool inward;  // against the outward normal
};

// Whether the moved ray passes through, between its moved ends.
bool exact_passage(const Point3& a, const Point3& b, const Point3& c, const RayFrame& frame, const Search& search,
                   Passage& passage);
bool exact_passage(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const RayFrame& frame,
                   const Search& search, Passage& passage);
// In their order; how many there are. \pre radius is not 0; negative: the normal points inward
int exact_passages(const Point3& center, double radius, const RayFrame& frame, const Search& search,
                   Passage (&passages)[2]);

// The sign of n.d, n being the outward normal.
int exact_facing(const Point3& a, const Point3& b, const Point3& c, const RayFrame& frame);
int exact_facing(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const RayFrame& frame);

// Whether the origin lies on the closed shape, exactly.
bool is_origin_on(const Point3& a, const Point3& b, const Point3& c, const RayFrame& frame);
bool is_origin_on(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const RayFrame& frame);
bool is_origin_on(const Point3& center, double radius, const RayFrame& frame);

// The sign of n.d, n = u x v; 0 where double cannot tell. Edges may be off by a rounding. Each coordinate of n is off
// by 8 units of |u| |v|, its product with d by 9, the sum of three by 42 in all; a direction that is off by s adds 6 s.
inline int facing(const Vec3& u, const Vec3& v, const RayFrame& frame) {
    const double edges = max_abs(u) * max_abs(v), along = max_abs(frame.ray.direction);
    const double product = dot(cross(u, v), frame.ray.direction);
    const double error = edges * (64 * kRoundoff * along + 7 * frame.direction_error) + 0x1p-900;
    return product > error ? 1 : product < -error ? -1 : 0;
}

}  // namespace limn
