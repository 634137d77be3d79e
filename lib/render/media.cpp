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

template <class Visit>
void MediaAlongRay::for_each_stretch(const Visit& visit) const {
    double extinction = 0, t = 0;
    int inside = 0;
    for (std::size_t i = 0; i < steps_.size(); ++i) {
        if (inside > 0 && !visit(i, t, extinction)) return;
        t = steps_[i].t;
        inside += steps_[i].extinction > 0 ? 1 : -1;
        extinction = inside == 0 ? 0 : extinction + steps_[i].extinction;  // no remainder of rounding outside
    }
}

double MediaAlongRay::transmittance() const {
    double depth = 0;
    for_each_stretch([&](std::size_t end, double t, double extinction) {
        depth += extinction * (steps_[end].t - t);
        return true;
    });
    return std::exp(-depth);
}

// Of the media entered and not yet left before step `end`, one in proportion to its extinction.
const MediaAlongRay::Step& MediaAlongRay::choose_medium(std::size_t end, double pick) const {
    const auto last = steps_.begin() + static_cast<std::ptrdiff_t>(end);
    const Step* chosen = nullptr;
    for (auto entered = steps_.begin(); entered != last; ++entered) {
        if (entered->extinction < 0) continue;
        const bool left = std::any_of(entered + 1, last,
                                      [&](const Step& s) { return s.medium == entered->medium && s.extinction < 0; });
        if (left) continue;
        chosen = &*entered;
        if ((pick -= entered->extinction) < 0) break;
    }
    return *chosen;
}

std::optional<FreeFlight> MediaAlongRay::sample(double random, double choose) const {
    double depth = -std::log1p(-random);  // 53 bits: up to 36.7 mean free paths
    std::optional<FreeFlight> flight;
    for_each_stretch([&](std::size_t end, double t, double extinction) {
        const double stretch = extinction * (steps_[end].t - t);
        if (stretch > depth) {
            const Step& medium = choose_medium(end, choose * extinction);
            flight = {t + depth / extinction, scene_->medium_shapes[scene_->media[medium.medium].shape].phase};
            return false;
        }
        depth -= stretch;
        return true;
    });
    return flight;
}

}  // namespace limn::tracing
