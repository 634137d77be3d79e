#include "render/media.h"

#include <algorithm>
#include <cmath>

namespace limn::tracing {

namespace {

// Crossings of one surface point come once for each primitive that meets there, their t apart by rounding alone.
// Doubles place them to some 2^-48; true crossings that close bound no visible depth.
bool same_point(double a, double b) { return std::abs(a - b) <= 0x1p-40 * std::abs(a); }

// Of the crossings at one point: one if all go the same way, none if the ray only touches.
std::size_t collapse(std::vector<kernels::Crossing>& crossings) {
    std::sort(crossings.begin(), crossings.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < crossings.size();) {
        bool inward = false, outward = false;
        const double t = crossings[i].t;
        for (; i < crossings.size() && same_point(t, crossings[i].t); ++i)
            (crossings[i].inward ? inward : outward) = true;
        if (inward != outward) crossings[kept++] = {t, inward};
    }
    return kept;
}

}  // namespace

void MediaAlongRay::trace(const flat::Scene& scene, const Ray& ray) {
    scene_ = &scene;
    t_max_ = ray.t_max;
    steps_.clear();
    for (std::uint32_t i = 0; i < scene.media.size(); ++i) add_intervals(scene, i, ray);
    std::sort(steps_.begin(), steps_.end(), [](const Step& a, const Step& b) { return a.t < b.t; });
}

void MediaAlongRay::add_intervals(const flat::Scene& scene, std::uint32_t medium, const Ray& ray) {
    const double extinction = scene.medium_shapes[scene.media[medium].shape].density * length(ray.direction);
    if (extinction == 0) return;
    Ray beyond = ray;
    beyond.t_max = kInfinity;
    kernels::crossings(scene, scene.media[medium], beyond, crossings_);
    const std::size_t count = collapse(crossings_);
    const auto add = [&](double from, double to) {
        if (!(from < std::min(to, t_max_))) return;
        steps_.push_back({from, extinction, medium});
        steps_.push_back({std::min(to, t_max_), -extinction, medium});
    };
    std::size_t i = count % 2;  // odd: the ray starts inside
    if (i == 1) add(ray.t_min, crossings_[0].t);
    for (; i + 1 < count; i += 2) add(crossings_[i].t, crossings_[i + 1].t);
}

double MediaAlongRay::transmittance() const {
    double depth = 0, extinction = 0, t = 0;
    int inside = 0;
    for (const Step& step : steps_) {
        if (inside > 0) depth += extinction * (step.t - t);
        t = step.t;
        inside += step.extinction > 0 ? 1 : -1;
        extinction = inside == 0 ? 0 : extinction + step.extinction;
    }
    return std::exp(-depth);
}

std::optional<FreeFlight> MediaAlongRay::sample(double random, double choose) const {
    double depth = -std::log1p(-random);  // 53 bits: up to 36.7 mean free paths
    double extinction = 0, t = 0;
    int inside = 0;
    for (std::size_t i = 0; i < steps_.size(); ++i) {
        const double stretch = inside > 0 ? extinction * (steps_[i].t - t) : 0;
        if (stretch > depth) {
            // The media entered and not yet left are those whose changes so far do not cancel.
            double pick = choose * extinction;
            const Step* chosen = nullptr;
            for (std::size_t j = 0; j < i; ++j) {
                if (steps_[j].extinction < 0) continue;
                const bool left = std::any_of(steps_.begin() + static_cast<std::ptrdiff_t>(j) + 1,
                                              steps_.begin() + static_cast<std::ptrdiff_t>(i), [&](const Step& s) {
                                                  return s.medium == steps_[j].medium && s.extinction < 0;
                                              });
                if (left) continue;
                chosen = &steps_[j];
                if ((pick -= steps_[j].extinction) < 0) break;
            }
            const MediumRecord& shape = scene_->medium_shapes[scene_->media[chosen->medium].shape];
            return FreeFlight{t + depth / extinction, shape.phase};
        }
        depth -= stretch;
        t = steps_[i].t;
        inside += steps_[i].extinction > 0 ? 1 : -1;
        extinction = inside == 0 ? 0 : extinction + steps_[i].extinction;
    }
    return std::nullopt;
}

}  // namespace limn::tracing
