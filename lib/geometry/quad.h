// Parallelograms as primitives.
#pragma once

#include <tuple>

#include "geometry/plane_normal.h"
#include "geometry/triangle.h"

namespace limn::primitives {

struct Quad : QuadRecord, Primitive {
    static constexpr PrimitiveKind kKind = PrimitiveKind::quad;
    static constexpr const char* kName = "quad";
    static constexpr auto kRecords = &SceneRecords::quads;
    static auto fields(const QuadRecord& q) { return std::tie(q.corner, q.edge_u, q.edge_v, q.material); }

    Normal3 normal;  // unit length
    Vec3 error;      // bounds the rounding error of a hit point along each axis

    explicit Quad(const QuadRecord& q)
        : QuadRecord(q), normal(quad_normal(q.edge_u, q.edge_v)), error(planar_error(q.corner, q.edge_u, q.edge_v)) {}

    Box bounds() const { return quad_bounds(corner, edge_u, edge_v); }
    double packed_error() const {
        return std::max({float_error(corner), float_error(corner, edge_u), float_error(corner, edge_v)});
    }
    auto pack() const { return Triangle(TriangleVertices{corner, corner + edge_u, corner + edge_v}).pack(); }
    Patch patch() const { return {corner, edge_u, edge_v}; }
    void surface(const Ray&, const PlanarHit& found, bool, Surface& s) const {
        on_patch(patch(), normal, error, found, s);
    }
};

}  // namespace limn::primitives
