// Media along a ray: where each begins and ends, the free flight through them, and how much light passes.
#pragma once

#include <optional>
#include <vector>

#include "flat/scene.h"
#include "limn/math/ray.h"
#include "limn/math/surface.h"
#include "trace/traverse.h"

namespace limn::transport {

// How far a path gets through media.
struct FreeFlight {
    bool scatters = false;
    double t = 0;                         // where it scatters, and by which phase function
    MaterialId phase = MaterialId::none;  //
    double depth = 0;                     // optical depth in scattering up to the end, if it does not
    double weight = 1;                    // what the throughput is multiplied by
    double density = 0;                   // per world unit of length, of its scattering there
};

// Returns the point of the ray at which the flight ends, with the phase function of the medium as its material.
// \pre flight.scatters
inline Surface point_in_medium(const Ray& ray, const FreeFlight& flight) {
    Surface point;
    point.position = ray.at(flight.t);
    point.material.id = static_cast<std::uint32_t>(flight.phase);
    return point;
}

// From one t of a ray to another.
struct Stretch {
    double from, to;
};

// Extinction along one ray, a step function of t. It is worked out anew for each ray from the crossings of all
// boundaries up to infinity: a point is inside where their number ahead is odd, which is decided exactly at edges and
// vertices too. So nothing is carried along the path, and the eye, lights and scattering points may be anywhere;
// boundaries may be hollow, non-convex and overlapping.
// Reuse one object for many rays: it keeps its memory.
class MediaAlongRay {
public:
    // \pre is_usable(ray). Up to ray.t_max.
    void trace(const flat::Scene& scene, const Ray& ray);

    // exp(-integral of the extinction) up to t_max.
    double transmittance() const;

    // The flight to the next scattering, through all media at once, which lies where the optical depth in scattering
    // reaches `depth`, exponentially distributed; `choose` in [0, 1) picks the medium in proportion to its scattering
    // there. What is absorbed does not end the flight but makes it count less.
    FreeFlight sample(double depth, double choose) const;
    // The flight that scatters at t, if there is a medium that can.
    FreeFlight scatter_at(double t, double choose) const;

    // From where light can scatter to the last such place before the optical depth exceeds `deepest`, or scattering
    // changes by more than the factor `most_change`.
    std::optional<Stretch> scattering_stretch(double deepest, double most_change) const;

private:
    struct Step {
        double t;
        double extinction, scattering;  // change, per world unit of length
        std::uint32_t medium;
    };
    void add_intervals(const flat::Scene& scene, std::uint32_t medium, const Ray& ray);
    void add_interval(double from, double to, double extinction, std::uint32_t medium);
    // visit(end, t, extinction, scattering) for each stretch inside media, from t to step `end`, until it returns
    // false.
    template <class Visit>
    void for_each_stretch(const Visit& visit) const;
    const Step& choose_medium(std::size_t end, double pick) const;
    void scatter(FreeFlight& flight, const Step& medium) const;

    const flat::Scene* scene_ = nullptr;
    double t_max_ = 0, speed_ = 1;  // t is in units of the ray's direction, `speed_` long
    std::vector<std::uint32_t> met_;
    std::vector<trace::Crossing> crossings_;
    std::vector<Step> steps_;  // sorted by t; every medium entered is left again at t_max_ at the latest
};

}  // namespace limn::transport
