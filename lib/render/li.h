// The reference path tracer, which is the one to read first. It traces one path at a time, in the words of the
// rendering equation. PathTracer (path.h) gives the same samples, but traces many paths together.
#pragma once

#include "limn/math/ray.h"
#include "render/path.h"
#include "render/path_settings.h"
#include "render/sampler.h"

namespace limn::transport {

// Returns one sample of the radiance Li(o, d) that arrives at the origin o of a camera ray from its direction d.
Path li(const PathSettings& settings, Ray ray, const Sampler& sampler);

}  // namespace limn::transport
