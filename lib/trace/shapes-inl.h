// The filters of the primitives in the tables. The include guard is per target, as Highway requires.
#if defined(LIMN_TRACE_SHAPES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_TRACE_SHAPES_INL_H
#undef LIMN_TRACE_SHAPES_INL_H
#else
#define LIMN_TRACE_SHAPES_INL_H
#endif

#include <array>
#include <bit>
#include <functional>

#include "flat/scene.h"
#include "geometry/quad-inl.h"
#include "geometry/sphere-inl.h"
#include "geometry/triangle-inl.h"
#include "math/sphere_uv.h"

HWY_BEFORE_NAMESPACE();
namespace limn::trace::HWY_NAMESPACE {

using namespace limn::HWY_NAMESPACE;

// Return the predicate of a row. `time` is that of the ray.
HWY_INLINE auto shape_of(const primitives::Sphere& s, double) { return sphere_of<double>(s.center, s.radius); }
HWY_INLINE auto shape_of(const primitives::MovingSphere& s, double time) { return shape_of(s.at(time), time); }
HWY_INLINE auto shape_of(const primitives::Quad& q, double) { return quad_of<double>(q.corner, q.edge_u, q.edge_v); }
HWY_INLINE auto shape_of(const primitives::Triangle& t, double) { return triangle_of<double>(t.a, t.b, t.c); }

// Other kinds have no predicate: the row intersects itself.
template <class Kind>
HWY_INLINE auto shape_of(const Kind& row, double) {
    return std::cref(row);
}

template <unsigned kKinds, class Kind, class Visit>
HWY_INLINE bool visit_row(const std::vector<Kind>& rows, PrimitiveKind kind, std::uint32_t row, double time,
                          const Visit& visit) {
    if constexpr ((kKinds & flat::bit(Kind::kKind)) != 0)
        if (kind == Kind::kKind) return visit(shape_of(rows[row], time));
    return false;
}
template <unsigned kKinds, class Visit, class... Kind>
HWY_INLINE bool visit_row(const std::tuple<std::vector<Kind>...>& tables, PrimitiveKind kind, std::uint32_t row,
                          double time, const Visit& visit) {
    return (visit_row<kKinds>(std::get<std::vector<Kind>>(tables), kind, row, time, visit) || ...);
}

// Calls visit() with the predicate of a row of the table of its kind, or of triangle `element` of a mesh, and returns
// the result. Returns false if the kind is not in the set kKinds.
template <unsigned kKinds, class Visit>
HWY_INLINE bool with_shape(const flat::Scene& scene, PrimitiveKind kind, std::uint32_t row, std::uint32_t element,
                           double time, const Visit& visit) {
    if constexpr ((kKinds & flat::bit(PrimitiveKind::mesh)) != 0)
        if (kind == PrimitiveKind::mesh) {
            const TriangleVertices v = flat::triangle_of(scene, scene.meshes[row], element);
            return visit(triangle_of<double>(v.a, v.b, v.c));
        }
    return visit_row<kKinds>(scene.rows, kind, row, time, visit);
}

}  // namespace limn::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
