#include "render/media.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/elementary.h"

namespace limn::transport {

namespace {

// Extinctions at the end of double must add up, and go away again where they end: infinities would leave NaN.
constexpr double kLargestExtinction = 1e300;

}  // namespace

void MediaAlongRay::trace(const flat::Scene& scene, const Ray& ray) {
    scene_ = &scene;
    t_max_ = ray.t_max;
    steps_.clear();
    trace::media_met(scene, ray, met_);
    for (const std::uint32_t medium : met_) add_intervals(scene, medium, ray);
    if (steps_.empty()) return;
    speed_ = length(ray.direction);
    // A medium is left before it is entered again at the same place.
    const auto key = [](const Step& s) { return std::pair(s.t, s.extinction > 0); };
    std::sort(steps_.begin(), steps_.end(), [&](const Step& a, const Step& b) { return key(a) < key(b); });
}

void MediaAlongRay::add_intervals(const flat::Scene& scene, std::uint32_t medium, const Ray& ray) {
    const double extinction = std::min(scene.medium_shapes[scene.media[medium].shape].density, kLargestExtinction);
    if (extinction == 0) return;
    Ray beyond = ray;
    beyond.t_max = kInfinity;
    trace::crossings(scene, scene.media[medium], beyond, crossings_);
    std::sort(crossings_.begin(), crossings_.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
    // In pairs from the far end, which is outside.
    for (std::size_t i = crossings_.size(); i > 0; i -= std::min<std::size_t>(i, 2)) {
        const double from = i > 1 ? std::max(ray.t_min, crossings_[i - 2].t) : ray.t_min;
        add_interval(from, crossings_[i - 1].t, extinction, medium);
    }
}

void MediaAlongRay::add_interval(double from, double to, double extinction, std::uint32_t medium) {
    to = std::min(to, t_max_);
    if (!(from < to)) return;
    const double scattering = extinction * scene_->media[medium].scattered;
    steps_.push_back({from, extinction, scattering, medium});
    steps_.push_back({to, -extinction, -scattering, medium});
}

template <class Visit>
void MediaAlongRay::for_each_stretch(const Visit& visit) const {
    double extinction = 0, scattering = 0, t = 0;
    int inside = 0, scatterers = 0;
    for (std::size_t i = 0; i < steps_.size(); ++i) {
        if (inside > 0 && !visit(i, t, extinction, scattering)) return;
        const Step& step = steps_[i];
        t = step.t;
        inside += step.extinction > 0 ? 1 : -1;
        scatterers += step.scattering > 0 ? 1 : step.scattering < 0 ? -1 : 0;
        // No remainder of rounding outside.
        extinction = inside == 0 ? 0 : extinction + step.extinction;
        scattering = scatterers == 0 ? 0 : scattering + step.scattering;
    }
}

double MediaAlongRay::transmittance() const {
    double depth = 0;
    for_each_stretch([&](std::size_t end, double t, double extinction, double) {
        depth += extinction * ((steps_[end].t - t) * speed_);
        return true;
    });
    return exponential(-depth);
}

// Of the media entered and not yet left before step `end`, one in proportion to its scattering.
const MediaAlongRay::Step& MediaAlongRay::choose_medium(std::size_t end, double pick) const {
    const auto last = steps_.begin() + static_cast<std::ptrdiff_t>(end);
    const Step* chosen = nullptr;
    for (auto entered = steps_.begin(); entered != last; ++entered) {
        if (!(entered->scattering > 0)) continue;
        const bool left = std::any_of(entered + 1, last,
                                      [&](const Step& s) { return s.medium == entered->medium && s.extinction < 0; });
        if (left) continue;
        chosen = &*entered;
        if ((pick -= entered->scattering) < 0) break;
    }
    return *chosen;
}

void MediaAlongRay::scatter(FreeFlight& flight, const Step& medium) const {
    flight.scatters = true;
    flight.phase = scene_->medium_shapes[scene_->media[medium.medium].shape].phase;
    flight.weight = medium.extinction / medium.scattering;
}

// With extinction e = s + a, of which s is drawn for: light that comes from d on has the weight exp(-e d), and reaches
// there with probability exp(-s d), which leaves exp(-a d). At an event the albedo is multiplied by e exp(-e d) and the
// density is s exp(-s d). s is e times the largest albedo of any colour, so that no weight exceeds 1.
FreeFlight MediaAlongRay::sample(double depth, double choose) const {
    FreeFlight flight;
    double absorbed = 0;
    for_each_stretch([&](std::size_t end, double t, double extinction, double scattering) {
        const double way = (steps_[end].t - t) * speed_;
        const double absorption = std::max(0.0, extinction - scattering);
        if (scattering * way > depth - flight.depth) {
            const double before = (depth - flight.depth) / scattering;
            scatter(flight, choose_medium(end, choose * scattering));
            flight.t = t + before / speed_;
            absorbed += absorption * before;
            flight.density = scattering * exponential(-depth);
            return false;
        }
        flight.depth += scattering * way;
        absorbed += absorption * way;
        return true;
    });
    if (absorbed > 0) flight.weight *= exponential(-absorbed);
    return flight;
}

FreeFlight MediaAlongRay::scatter_at(double where, double choose) const {
    FreeFlight flight;
    double depth = 0, absorbed = 0;
    for_each_stretch([&](std::size_t end, double t, double extinction, double scattering) {
        if (where < t) return false;
        const bool inside = where < steps_[end].t;
        const double way = ((inside ? where : steps_[end].t) - t) * speed_;
        depth += scattering * way;
        absorbed += std::max(0.0, extinction - scattering) * way;
        if (!inside) return true;
        if (!(scattering > 0)) return false;
        scatter(flight, choose_medium(end, choose * scattering));
        flight.t = where;
        flight.weight *= exponential(-absorbed);
        flight.density = scattering * exponential(-depth);
        return false;
    });
    return flight;
}

std::optional<Stretch> MediaAlongRay::scattering_stretch(double deepest, double most_change) const {
    std::optional<Stretch> found;
    double first = 0;
    for_each_stretch([&](std::size_t end, double t, double extinction, double scattering) {
        if (found && scattering > 0 && (scattering > most_change * first || first > most_change * scattering))
            return false;
        const double way = (steps_[end].t - t) * speed_;
        const bool ends = extinction * way > deepest;
        const double to = ends ? t + deepest / extinction / speed_ : steps_[end].t;
        if (!found) first = scattering;
        if (scattering > 0 && to > t) found = Stretch{found ? found->from : t, to};
        deepest -= extinction * way;
        return !ends;
    });
    return found;
}

}  // namespace limn::transport
