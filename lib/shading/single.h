// The batch functions of this room for a single vertex of a path. The reference path tracer and the tests call them.
#pragma once

#include <cstdint>
#include <optional>

#include "flat/scene.h"
#include "limn/math/ray.h"
#include "limn/math/surface.h"
#include "shading/lights.h"

namespace limn::shade {

// A point at which light arrives.
struct Receiver {
    Point3 position;
    Vec3 normal;  // unit, of the side on which light counts; zero if light counts from everywhere
};

// Returns a vertex as the receiver of lights that its material makes it.
Receiver receiver_at(const flat::Scene& scene, const Surface& vertex);

// A receiver in the first row.
struct OneReceiver {
    explicit OneReceiver(const Receiver& receiver, double at_time = 0) : time{at_time} {
        position.set(0, receiver.position);
        normal.set(0, receiver.normal);
    }
    lights::Receivers rows() const { return {1, position, normal, time}; }

    sampling::Rows3 position, normal;
    sampling::Row time;
};

// A sampled direction towards a light.
struct LightSample {
    Vec3 direction;  // unit
    double pdf;      // per solid angle, the choice of the light included
    Color radiance;  // emitted towards the vertex
    Ray shadow_ray;  // from the vertex to the light
};

// Samples a light that a vertex receives. Returns nothing if no light is drawn. \pre the scene has lights
std::optional<LightSample> sample_light(const flat::Scene& scene, const Surface& vertex, double time,
                                        const Random3& random);
// Returns the pdf with which sample_light draws the direction from a receiver to a point of a primitive, or that of a
// distant light. `primitive` and `position` are explained in lights::LightHits.
double pdf_light(const flat::Scene& scene, const Receiver& receiver, double time, std::uint64_t primitive,
                 const Point3& position);

// Samples the direction from which light is scattered into the direction `out`, which may have any length. Returns
// nothing if the light is absorbed.
std::optional<ScatterSample> sample_material(const flat::Scene& scene, const Surface& vertex, const Vec3& out,
                                             const Random3& random);
// Returns f |cos| for light that is scattered from direction `in` into direction `out`, and the pdf with which
// sample_material draws `in`.
ScatterValue material_value(const flat::Scene& scene, const Surface& vertex, const Vec3& out, const Vec3& in);

// Returns the weight of a technique with pdf a that is combined with a technique with pdf b (math/heuristic-inl.h).
double power_heuristic(double a, double b);

}  // namespace limn::shade
