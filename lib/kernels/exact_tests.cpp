#include "kernels/exact_tests.h"

#include "predicates/quad.h"
#include "predicates/triangle.h"

namespace limn::kernels {

const ShearedRay& ExactTests::sheared() {
    if (!sheared_) sheared_.emplace(frame_, extent_);
    return *sheared_;
}

const SphereRay& ExactTests::round() {
    if (!round_) round_.emplace(frame_);
    return *round_;
}

bool ExactTests::triangle(const Point3& a, const Point3& b, const Point3& c, const Search& search, PlanarHit& hit) {
    return intersect_triangle(a, b, c, sheared(), search, hit);
}

bool ExactTests::quad(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const Search& search,
                      PlanarHit& hit) {
    return intersect_quad(corner, edge_u, edge_v, sheared(), search, hit);
}

SphereHits ExactTests::sphere(const Point3& center, double radius, const Search& search, bool both) {
    return intersect_sphere(center, radius, round(), search, both);
}

bool ExactTests::sphere(const Point3& center, double radius, const Search& search, double& t) {
    return intersect_sphere(center, radius, round(), search, t);
}

}  // namespace limn::kernels
