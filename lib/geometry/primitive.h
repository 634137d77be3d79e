// The interface of the kinds of primitives. Each kind is a struct in a file of this folder, and an entry in registry.h.
// A compiled scene has a table for each kind, with one object of the struct for each primitive. Other rooms call these
// objects, or the registry. Two files have a case of their own for each kind: trace/closest_point.cpp (the nearest
// point; the compiler reports a missing case) and query/open_edges.cpp (only if the kind has edges or a rim).
//
// Each kind has these members:
//
//     static constexpr PrimitiveKind kKind
//     static constexpr const char* kName             its name in CompiledScene::features()
//     static constexpr auto kRecords                 the table of SceneRecords that describes it
//     static auto fields(record)                     the fields of a record that the digest covers; only one of the
//                                                    kinds that share a table of records has this
//     Kind(record)
//     MaterialId material
//     Box bounds() const
//     void surface(ray, found, with_uv, out) const   writes the surface at the hit `found` to `out`, in the primitive's
//                                                    own space, with outward normals (an output parameter, because a
//                                                    copy of the result would stall on its recent stores)
//     void tangents(out) const                       writes dp_du and dp_dv of the surface that surface() wrote; not
//                                                    needed if the kind has a patch, whose edges are the tangents
//     bool intersect(frame, search, hit) const       finds the first hit; not needed if trace/shapes-inl.h calls the
//                                                    predicate itself
//
// A kind whose leaves are tested by the float filter, up to eight primitives at once, has a case in
// trace/traversal-inl.h and these members:
//
//     std::array<float, n> pack() const              returns the primitive's rows in a block: see flat::Form
//     double packed_error() const                    returns the largest distance by which pack() moves its points
//
// A planar kind that can be sampled as a light has this member:
//
//     Patch patch() const                            returns a parallelogram around it; u and v of a hit are the
//                                                    weights of its edges
//
// If the primitive doesn't fill its patch, it also has these:
//
//     static constexpr double kShare                 its area divided by that of the patch
//     static Uv weights(u, v)                        maps the unit square to the primitive, uniformly by area
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/bounds.h"
#include "geometry/filter.h"
#include "geometry/hit_error.h"
#include "limn/math/surface.h"
#include "limn/records/records.h"

namespace limn::primitives {

// The base of every kind, with defaults of the members above.
struct Primitive {
    static constexpr double kShare = 1;
    static Uv weights(double u, double v) { return {u, v}; }
    double packed_error() const { return 0; }
};

// A parallelogram.
struct Patch {
    Point3 corner;
    Vec3 edge_u, edge_v;
};

// Writes the surface at the hit `found` on a patch. `error` bounds the rounding error of its position.
inline void on_patch(const Patch& patch, const Normal3& normal, const Vec3& error, const PlanarHit& found, Surface& s) {
    s.position = patch.corner + (found.u * patch.edge_u + found.v * patch.edge_v);
    s.position_error = error;
    s.normal = s.shading_normal = normal;
    s.uv = {found.u, found.v};
}

// Returns the numbers, each rounded to the nearest float.
template <class... Doubles>
std::array<float, sizeof...(Doubles)> to_floats(Doubles... x) {
    return {static_cast<float>(x)...};
}

// Returns the error of rounding a double to the nearest float. For a point this is the largest error along an axis.
inline double float_error(double x) { return std::abs(x - static_cast<double>(static_cast<float>(x))); }
inline double float_error(const Point3& p) { return std::max({float_error(p.x), float_error(p.y), float_error(p.z)}); }

// Returns the same for the sum of a point and an edge, plus the rounding error of the sum. That error is computed
// exactly (see difference_up in geometry/bounds.h).
inline double float_error(const Point3& p, const Vec3& edge) {
    double most = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        const double sum = p[a] + edge[a], added = sum - p[a], rounding = (p[a] - (sum - added)) + (edge[a] - added);
        most = std::max(most, float_error(sum) + std::abs(rounding));
    }
    return most;
}

}  // namespace limn::primitives
