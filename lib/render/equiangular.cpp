#include "render/equiangular.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"

namespace limn::transport {

namespace {

// The radius of the ball that all lights are taken for, divided by the half diagonal of their box. A value of 1 is up
// to 15 % worse below quads.
constexpr double kRadius = 0.5;
// The least radius of that ball, divided by the largest coordinate of all media (Scene::media_extent). The box of a
// single point light has no diagonal, and a ray may pass through the point.
constexpr double kLeastRadius = 1e-6;
// Equiangular sampling is used if the stretch spans at least this angle in radians as seen from the lights. Within a
// smaller angle 1 / distance^2 changes little.
constexpr double kLeastAngle = 0.7;
// The largest optical depth of the stretch. Hardly any light arrives from beyond.
constexpr double kDeepest = 3;
// The largest factor by which scattering changes along the stretch. If media are thin here and thick there, free
// flights distribute samples better.
constexpr double kMostChange = 3;
// These values are measured. Time times error, divided by that of light sampling where free flights end:
//   fog of optical depth 0.1, 0.3, 1, 3 in a room around a small ball in its middle: 0.4, 0.3, 0.3, 0.4
//   the same fog around a quad below the ceiling: 0.8, 0.6, 0.5, 0.6
//   27 balls all over the room: 0.9
//   figure 16: 1.0; without kLeastAngle 1.05

}  // namespace

Equiangular::Equiangular(const Ray& ray, const Stretch& stretch, const Point3& pivot, double least_height)
    : stretch_(stretch), speed_(length(ray.direction)) {
    const Vec3 way = pivot - ray.origin, along = ray.direction / speed_;
    middle_ = dot(way, along);
    height_ = std::max(length(way - middle_ * along), least_height);
    begin_ = arc_tangent((stretch.from * speed_ - middle_) / height_);
    end_ = arc_tangent((stretch.to * speed_ - middle_) / height_);
}

double Equiangular::sample(double u) const {
    const double t = (middle_ + height_ * tangent(begin_ + u * angle())) / speed_;
    return std::clamp(t, stretch_.from, stretch_.to);
}

double Equiangular::pdf(double t) const {
    const double slope = (t * speed_ - middle_) / height_;
    return 1 / (angle() * height_ * (1 + slope * slope));
}

LightsAsPivot::LightsAsPivot(const flat::Scene& scene) : any_(scene.lights.size() > 0 && !scene.media.empty()) {
    if (!any_) return;
    Vec3 half;
    if (scene.lights.nodes.empty()) {
        flat::Light room;
        const Box box = flat::box_of(flat::light_at(scene, 0, 0.5, room));
        pivot_ = box.center();
        half = box.diagonal() / 2;
    } else {
        const flat::LightNode& all = scene.lights.nodes[0];
        pivot_ = {all.center[0], all.center[1], all.center[2]};
        half = {all.half[0], all.half[1], all.half[2]};
    }
    radius_ = std::max(kRadius * length(half), kLeastRadius * scene.media_extent);
}

std::optional<Equiangular> LightsAsPivot::along(const Ray& ray, const MediaAlongRay& media) const {
    if (!any_) return std::nullopt;
    const std::optional<Stretch> stretch = media.scattering_stretch(kDeepest, kMostChange);
    if (!stretch) return std::nullopt;
    const Equiangular along(ray, *stretch, pivot_, radius_);
    return along.angle() > kLeastAngle ? std::optional(along) : std::nullopt;
}

}  // namespace limn::transport
