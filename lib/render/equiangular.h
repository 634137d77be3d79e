// Where on a segment through media to ask for the light that comes straight from lights and is scattered once: as
// densely as 1 / distance^2 from them. Free flights know nothing of lights, so that they rarely end near a small one,
// and then bring much.
#pragma once

#include <optional>

#include "flat/scene.h"
#include "limn/math/ray.h"
#include "render/media.h"

namespace limn::transport {

// Equiangular sampling: a point of a line is drawn such that its direction, as seen from a pivot, has a uniform angle.
// Kulla and Fajardo, Importance Sampling Techniques for Path Tracing in Participating Media, Computer Graphics Forum
// 31(4), 2012.
class Equiangular {
public:
    // The pivot counts as at least `least_height` away from the line: lights are no points.
    Equiangular(const Ray& ray, const Stretch& stretch, const Point3& pivot, double least_height);

    double angle() const { return end_ - begin_; }  // between both ends
    const Stretch& stretch() const { return stretch_; }
    double sample(double u) const;  // t
    double pdf(double t) const;     // per world unit of length. \pre t is in the stretch

private:
    Stretch stretch_;
    double speed_, middle_, height_;  // of the ray; of the pivot along and above it, in world units
    double begin_, end_;              // angles from the perpendicular
};

// The lights of a scene as one pivot, however many there are: which of them is asked is chosen at the point drawn.
class LightsAsPivot {
public:
    explicit LightsAsPivot(const flat::Scene& scene);

    // Nothing where free flights do as well.
    std::optional<Equiangular> along(const Ray& ray, const MediaAlongRay& media) const;

private:
    bool any_ = false;
    Point3 pivot_;
    double radius_ = 0;
};

}  // namespace limn::transport
