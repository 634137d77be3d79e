// Chooses the point of a ray through media at which light sampling is done, with a pdf in proportion to
// 1 / distance^2 from the lights. Free flights ignore the lights. They rarely end near a small light, and the paths
// that do end there contribute much.
#pragma once

#include <optional>

#include "flat/scene.h"
#include "limn/math/ray.h"
#include "render/media.h"

namespace limn::transport {

// Equiangular sampling: samples a point of a line so that the angle of its direction from a pivot is uniform (Kulla and
// Fajardo, Importance Sampling Techniques for Path Tracing in Participating Media, Computer Graphics Forum 31(4),
// 2012).
class Equiangular {
public:
    // If the pivot is closer to the line than `least_height`, it is taken to be at that distance, because lights have a
    // size.
    Equiangular(const Ray& ray, const Stretch& stretch, const Point3& pivot, double least_height);

    // Returns the angle between the two ends of the stretch as seen from the pivot, in radians.
    double angle() const { return end_ - begin_; }
    const Stretch& stretch() const { return stretch_; }
    // Returns the t of a sample. \pre u is in [0, 1)
    double sample(double u) const;
    // Returns the pdf of a sample per world unit of length. \pre t is in the stretch
    double pdf(double t) const;

private:
    Stretch stretch_;
    double speed_;        // length of the ray's direction
    double middle_;       // distance along the ray from its origin to the foot of the perpendicular from the pivot
    double height_;       // distance of the pivot from the ray, in world units as middle_
    double begin_, end_;  // angles of the ends of the stretch from the perpendicular
};

// The lights of a scene, taken as one pivot. The light to sample is chosen at the sampled point.
class LightsAsPivot {
public:
    explicit LightsAsPivot(const flat::Scene& scene);

    // Returns the sampling of points along a ray, or std::nullopt if free flights do as well.
    std::optional<Equiangular> along(const Ray& ray, const MediaAlongRay& media) const;

private:
    bool any_ = false;
    Point3 pivot_;
    double radius_ = 0;
};

}  // namespace limn::transport
