// Primitives with a row for each in a table of their own. A kind is a struct beside this file, its row, and an entry in
// registry.h; other rooms call the row, or the registry for it. Two need a line of their own: trace/closest_point.cpp
// (the nearest point on it; the compiler says so) and query/open_edges.cpp (if it has edges or a rim). It has
//
//     static constexpr PrimitiveKind kKind
//     static constexpr const char* kName             in CompiledScene::features()
//     static constexpr auto kRecords                 the table of SceneRecords that it is described in
//     static auto fields(record)                     of these, for the digest; not for a table's second kind
//     Kind(record)
//     MaterialId material
//     Box bounds() const
//     void surface(ray, found, with_uv, out) const   as it is met at `found`, in its own space, its normals outward; in
//                                                    place: a copy would wait for what was just written
//     bool intersect(frame, search, hit) const       the first hit, unless trace/shapes-inl.h knows its predicate
//
// Where leaves test several at once in float (a case in trace/traversal-inl.h), in place of the box and one by one:
//
//     std::array<float, n> pack() const              its rows in a block: see flat::rows_of
//     double packed_error() const                    how far what they stand for moves by that
//
// Where it lies in a plane and can be sampled as a light:
//
//     Patch patch() const                            around it; u and v of a hit are the weights of its edges
//
// and, if it is not the whole of its patch
//
//     static constexpr double kShare                 how much it is
//     static Uv weights(u, v)                        a point of it, by area: from the unit square
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "limn/core/surface.h"
#include "limn/records.h"
#include "predicates/bounds.h"
#include "predicates/filter.h"
#include "predicates/hit_error.h"

namespace limn::primitives {

// What a kind need not say.
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

inline void on_patch(const Patch& patch, const Normal3& normal, const Vec3& error, const PlanarHit& found, Surface& s) {
    s.position = patch.corner + (found.u * patch.edge_u + found.v * patch.edge_v);
    s.position_error = error;
    s.normal = s.shading_normal = normal;
    s.uv = {found.u, found.v};
}

// Each rounded to the nearest float.
template <class... Doubles>
std::array<float, sizeof...(Doubles)> to_floats(Doubles... x) {
    return {static_cast<float>(x)...};
}

// How far a number moves when it is packed as float.
inline double float_error(double x) { return std::abs(x - static_cast<double>(static_cast<float>(x))); }
inline double float_error(const Point3& p) { return std::max({float_error(p.x), float_error(p.y), float_error(p.z)}); }

// The same for a sum, whose own rounding is exact in double (difference_up).
inline double float_error(const Point3& p, const Vec3& edge) {
    double most = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        const double sum = p[a] + edge[a], added = sum - p[a], rounding = (p[a] - (sum - added)) + (edge[a] - added);
        most = std::max(most, float_error(sum) + std::abs(rounding));
    }
    return most;
}

}  // namespace limn::primitives
