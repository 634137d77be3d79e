// Directions towards emitters for many receivers at once, each with its density per solid angle.
#pragma once

#include <cstddef>
#include <cstdint>

#include "flat/scene.h"
#include "math/rows.h"

namespace limn::lights {

using sampling::kShaded, sampling::Row, sampling::Rows3;

struct Receivers {
    std::size_t count;
    const Rows3& position;
    const Rows3& normal;  // unit, of the side on which light counts; zero where it counts from everywhere
    const Row& time;      // in shutter units
};

// A point on an emitter for each receiver.
struct LightSamples {
    const Row* numbers = nullptr;  // three, uniform: they choose a light, and a point on it

    // Results; nothing else counts where the pdf is 0, and no light was drawn.
    Row pdf = {};  // per solid angle at the receiver, the choice of the light included; without extent: kNoSolidAngle
    Row end = {};  // t of the shadow ray's end: just before 1, at the position; infinity if the light is distant
    Rows3 position, position_error, normal;  // the normal is on the receiver's side
    Rows3 direction;                         // unit, from the receiver
    Row u = {}, v = {};                      // of planar lights: weights of the edges; of the environment: of its map
    const flat::Light* light[kShaded] = {};
    flat::Light own[kShaded];  // those that are not kept anywhere
};

// Chooses a light about in proportion to what it would give if nothing were in the way, and a point on it: uniform per
// solid angle where the light is near; from afar, or almost edge-on, uniform per area, which is as good there and costs
// less. \pre there are lights
void sample(const flat::Scene& scene, const Receivers& receivers, LightSamples& samples);

// Points on primitives, and distant lights.
struct LightHits {
    std::uint64_t primitive[kShaded] = {};  // their numbers; of distant lights from flat::kFirstDistant on
    Rows3 position;                         // of distant lights the direction towards them, of any length
    // With which density `sample` would have drawn the direction from the receiver; 0 if the primitive is no light that
    // can be sampled.
    Row pdf = {};
};
void find_pdf(const flat::Scene& scene, const Receivers& receivers, LightHits& hits);

}  // namespace limn::lights
