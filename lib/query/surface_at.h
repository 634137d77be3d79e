#pragma once

#include "flat/scene.h"
#include "limn/math/ray.h"
#include "limn/math/surface.h"
#include "trace/traverse.h"

namespace limn::query {

// The surface at a hit. Traversal reports only t, u, v and the primitive. The rest is computed only for the hit that
// the caller keeps. It is computed in the primitive's own space and then transformed to world space, one instance after
// the other.
struct SurfaceHit {
    Surface surface;
    bool index_matched = false;  // true for the boundary of a medium, or if a user-defined shape says so
};

// Parts of a surface that a caller may leave out: the texture coordinates of a sphere, which cost more than everything
// else about it, and the tangents dp_du and dp_dv.
struct Parts {
    bool uv = true, tangents = true;
};

// Returns the surface at a hit. \pre `hit` was found for `ray` in `scene`
SurfaceHit surface_at(const flat::Scene& scene, const Ray& ray, const trace::Hit& hit, Parts parts = {});
// Writes the surface at a hit into `out`, which may hold an earlier one. Members that `parts` leaves out may keep their
// old values.
void surface_at(const flat::Scene& scene, const Ray& ray, const trace::Hit& hit, Parts parts, SurfaceHit& out);

}  // namespace limn::query
