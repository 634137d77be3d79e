#include "render/media.h"

#include <algorithm>
#include <cmath>

namespace limn::tracing {

namespace {

// Extinctions at the end of double must add up, and go away again where they end: infinities would leave NaN.
constexpr double kLargestExtinction = 1e300;

// In no plane and along no line that anybody would describe.
constexpr Vec3 kAside{0.4327561, -0.7915372, 0.4313921};

// Crossings of one surface point come once for each primitive that meets there, their t apart by rounding alone.
// Where primitives share an edge exactly their t are a few 2^-53 apart; true crossings that close bound no visible
// depth.
bool same_point(double a, double b) { return std::abs(a - b) <= 0x1p-40 * std::abs(a); }

// For each place where crossings are, in order, one of them, and whether the others there go the same way. It goes into
// `places`, replacing what is there.
void gather(std::vector<kernels::Crossing>& crossings, std::vector<MediaAlongRay::Place>& places) {
    std::sort(crossings.begin(), crossings.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
    places.clear();
    for (std::size_t i = 0; i < crossings.size();) {
        const kernels::Crossing& first = crossings[i];
        bool agree = true;
        for (; i < crossings.size() && same_point(first.t, crossings[i].t); ++i)
            agree = agree && crossings[i].inward == first.inward;
        places.push_back({first.t, agree});
    }
}

}  // namespace

void MediaAlongRay::trace(const flat::Scene& scene, const Ray& ray) {
    scene_ = &scene;
    t_max_ = ray.t_max;
    speed_ = length(ray.direction);
    steps_.clear();
    for (std::uint32_t i = 0; i < scene.media.size(); ++i) add_intervals(scene, i, ray);
    std::sort(steps_.begin(), steps_.end(), [](const Step& a, const Step& b) { return a.t < b.t; });
}

void MediaAlongRay::add_intervals(const flat::Scene& scene, std::uint32_t medium, const Ray& ray) {
    const double extinction = std::min(scene.medium_shapes[scene.media[medium].shape].density, kLargestExtinction);
    if (extinction == 0) return;
    Ray beyond = ray;
    beyond.t_max = kInfinity;
    kernels::crossings(scene, scene.media[medium], beyond, crossings_);
    gather(crossings_, places_);
    // From the far end, which is outside, to the near one.
    bool inside = false;
    double end = 0;
    for (std::size_t i = places_.size(); i-- > 0;) {
        const auto [t, is_crossed] = places_[i];
        const bool inside_before =
            is_crossed ? !inside : is_inside(scene, medium, ray, i > 0 ? places_[i - 1].t : ray.t_min, t);
        if (inside_before && !inside) end = t;
        if (!inside_before && inside) add_interval(t, end, extinction, medium);
        inside = inside_before;
    }
    if (inside) add_interval(ray.t_min, end, extinction, medium);
}

void MediaAlongRay::add_interval(double from, double to, double extinction, std::uint32_t medium) {
    to = std::min(to, t_max_);
    if (!(from < to)) return;
    steps_.push_back({from, extinction, medium});
    steps_.push_back({to, -extinction, medium});
}

// Of a stretch of the ray without crossings, from another ray that starts in its middle. That one meets no edges: it
// only touches where its crossings disagree.
bool MediaAlongRay::is_inside(const flat::Scene& scene, std::uint32_t medium, const Ray& ray, double from, double to) {
    const double middle = std::max(from, to - 1 - std::abs(to)) / 2 + to / 2;  // `from` may be -infinity
    const Ray aside{ray.at(middle), kAside, 0, kInfinity, ray.time};
    if (!is_usable(aside)) return false;
    kernels::crossings(scene, scene.media[medium], aside, crossings_);
    gather(crossings_, places_aside_);
    return std::count_if(places_aside_.begin(), places_aside_.end(), [](const Place& p) { return p.is_crossed; }) % 2;
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
        depth += extinction * ((steps_[end].t - t) * speed_);
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
        const double stretch = extinction * ((steps_[end].t - t) * speed_);
        if (stretch > depth) {
            const Step& medium = choose_medium(end, choose * extinction);
            flight = {t + depth / extinction / speed_, scene_->medium_shapes[scene_->media[medium.medium].shape].phase};
            return false;
        }
        depth -= stretch;
        return true;
    });
    return flight;
}

}  // namespace limn::tracing
