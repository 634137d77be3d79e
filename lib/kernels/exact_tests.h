// What the float forms leave open, or find: the intersections that every answer comes from, for one ray.
#pragma once

#include <optional>

#include "predicates/sheared_ray.h"
#include "predicates/sphere.h"

namespace limn::kernels {

class ExactTests {
public:
    // The frame is kept by reference. `extent`: see ShearedRay.
    ExactTests(const RayFrame& frame, double extent) : frame_(frame), extent_(extent) {}

    bool triangle(const Point3& a, const Point3& b, const Point3& c, const Search& search, PlanarHit& hit);
    bool quad(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const Search& search, PlanarHit& hit);
    SphereHits sphere(const Point3& center, double radius, const Search& search, bool both);
    bool sphere(const Point3& center, double radius, const Search& search, double& t);

private:
    // Many rays need none.
    const ShearedRay& sheared();
    const SphereRay& round();

    const RayFrame& frame_;
    double extent_;
    std::optional<ShearedRay> sheared_;
    std::optional<SphereRay> round_;
};

}  // namespace limn::kernels
