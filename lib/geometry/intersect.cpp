#include "geometry/intersect.h"

#include "geometry/mesh_triangle.h"
#include "geometry/quad-inl.h"
#include "geometry/sphere-inl.h"
#include "geometry/triangle-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn {

bool intersect_triangle(const Point3& a, const Point3& b, const Point3& c, const RayFrame& frame, const Search& search,
                        PlanarHit& hit) {
    return HWY_NAMESPACE::intersect(HWY_NAMESPACE::triangle_of<double>(a, b, c), frame, search, hit);
}

std::size_t intersect_mesh(const MeshView& mesh, const RayFrame& frame, const Search& search, PlanarHit& hit) {
    const HWY_NAMESPACE::ShearedRay<double> ray(HWY_NAMESPACE::ray_of<double>(frame));
    std::size_t nearest = mesh.triangles.size();
    hit.t = search.t_max;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const TriangleVertices v = triangle_vertices(mesh, i);
        PlanarHit found;
        if (!HWY_NAMESPACE::intersect(HWY_NAMESPACE::triangle_of<double>(v.a, v.b, v.c), ray, frame,
                                      {search.t_min, hit.t}, found))
            continue;
        if (found.t == hit.t && nearest != mesh.triangles.size()) continue;
        hit = found;
        nearest = i;
    }
    return nearest;
}

bool intersect_quad(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const RayFrame& frame,
                    const Search& search, PlanarHit& hit) {
    return HWY_NAMESPACE::intersect(HWY_NAMESPACE::quad_of<double>(corner, edge_u, edge_v), frame, search, hit);
}

bool intersect_sphere(const Point3& center, double radius, const RayFrame& frame, const Search& search,
                      PlanarHit& hit) {
    return HWY_NAMESPACE::intersect(HWY_NAMESPACE::sphere_of<double>(center, radius), frame, search, hit);
}

}  // namespace limn
HWY_AFTER_NAMESPACE();
