// Triangles as primitives. A triangle of a mesh is converted to this type once its vertices are known.
#pragma once

#include <tuple>

#include "geometry/mesh_triangle.h"
#include "geometry/primitive.h"
#include "limn/math/warp.h"

namespace limn::primitives {

struct Triangle : TriangleRecord, Primitive {
    static constexpr PrimitiveKind kKind = PrimitiveKind::triangle;
    static constexpr const char* kName = "triangle";
    static constexpr auto kRecords = &SceneRecords::triangles;
    static constexpr double kShare = 0.5;
    static Uv weights(double u, double v) { return sample_uniform_triangle(u, v); }
    static auto fields(const TriangleRecord& t) { return std::tie(t.a, t.b, t.c, t.material); }

    explicit Triangle(const TriangleRecord& t) : TriangleRecord(t) {}
    explicit Triangle(const TriangleVertices& v) : TriangleRecord{v.a, v.b, v.c, MaterialId::none} {}

    Box bounds() const { return triangle_bounds({a, b, c}); }
    double packed_error() const { return std::max({float_error(a), float_error(b), float_error(c)}); }
    std::array<float, 9> pack() const { return to_floats(a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z); }
    Patch patch() const { return {a, b - a, c - a}; }
    void surface(const Ray&, const PlanarHit& found, bool, Surface& s) const {
        on_patch(patch(), triangle_normal(a, b, c), planar_error(a, b - a, c - a), found, s);
    }
};

}  // namespace limn::primitives
