// The primitives of the flat scene as the filters have them. Per-target include guard, as Highway has it.
#if defined(LIMN_KERNELS_SHAPES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_KERNELS_SHAPES_INL_H
#undef LIMN_KERNELS_SHAPES_INL_H
#else
#define LIMN_KERNELS_SHAPES_INL_H
#endif

#include <array>
#include <bit>

#include "core/sphere_uv.h"
#include "flat/scene.h"
#include "predicates/quad-inl.h"
#include "predicates/sphere-inl.h"
#include "predicates/triangle-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::kernels::HWY_NAMESPACE {

using namespace limn::HWY_NAMESPACE;

// visit(shape) with a triangle, quad or sphere: its row of the table of its kind, of a mesh its triangle `element`.
// kKinds: those that there may be.
template <unsigned kKinds, class Visit>
HWY_INLINE bool with_shape(const flat::Scene& scene, PrimitiveKind kind, std::uint32_t row, std::uint32_t element,
                           double time, const Visit& visit) {
    constexpr auto has = [](PrimitiveKind k) { return (kKinds & flat::bit(k)) != 0; };
    if constexpr (has(PrimitiveKind::sphere))
        if (kind == PrimitiveKind::sphere) {
            const flat::Sphere& s = scene.spheres[row];
            return visit(sphere_of<double>(s.center, s.radius));
        }
    if constexpr (has(PrimitiveKind::moving_sphere))
        if (kind == PrimitiveKind::moving_sphere) {
            const flat::MovingSphere& s = scene.moving_spheres[row];
            return visit(sphere_of<double>(interpolate(s.center0, s.center1, time), s.radius));
        }
    if constexpr (has(PrimitiveKind::quad))
        if (kind == PrimitiveKind::quad) {
            const flat::Quad& q = scene.quads[row];
            return visit(quad_of<double>(q.corner, q.edge_u, q.edge_v));
        }
    if constexpr (has(PrimitiveKind::triangle))
        if (kind == PrimitiveKind::triangle) {
            const flat::Triangle& t = scene.triangles[row];
            return visit(triangle_of<double>(t.a, t.b, t.c));
        }
    if constexpr (has(PrimitiveKind::mesh))
        if (kind == PrimitiveKind::mesh) {
            const TriangleVertices v = flat::triangle_of(scene, scene.meshes[row], element);
            return visit(triangle_of<double>(v.a, v.b, v.c));
        }
    return false;
}

}  // namespace limn::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
