#pragma once

#include "flat/scene.h"
#include "limn/core/ray.h"
#include "limn/core/surface.h"
#include "trace/traverse.h"

namespace limn::query {

// The second step of a hit, made once for the hit that is kept: its point in the primitive's own space, taken outward
// through the instances.
struct SurfaceHit {
    Surface surface;
    bool index_matched = false;  // the boundary of a medium, or a user-defined shape that says so
};

// What may be left out: texture coordinates of a sphere, which cost more than the rest of it, and dp_du and dp_dv.
struct Parts {
    bool uv = true, tangents = true;
};

// \pre `hit` was found for `ray` in `scene`
SurfaceHit surface_at(const flat::Scene& scene, const Ray& ray, const trace::Hit& hit, Parts parts = {});
// The same for an object that is used again, so that what is not asked for is not set either.
void surface_at(const flat::Scene& scene, const Ray& ray, const trace::Hit& hit, Parts parts, SurfaceHit& out);

}  // namespace limn::query
