// The ideal diffuse lobe, f = albedo / pi, around the shading normal. What lies below the geometric surface is
// absorbed, so that an interpolated normal cannot send light through the wall (Veach, Robust Monte Carlo Methods for
// Light Transport Simulation, 1997, section 5.3).
#pragma once

#include <optional>

#include "limn/core/frame.h"
#include "limn/core/math.h"
#include "limn/core/surface.h"
#include "limn/core/warp.h"

namespace limn::bsdf {

/// f |cos| and its density, both proportional to the cosine: their ratio is the albedo.
inline ScatterValue value_lambertian(const Color& albedo, const Surface& s, const Vec3& /*out*/, const Vec3& in) {
    const double cosine = dot(in, s.shading_normal);
    if (!(dot(in, s.normal) > 0 && cosine > 0)) return {};
    return {.value = albedo * (cosine / kPi), .pdf = pdf_cosine_hemisphere(cosine)};
}

inline std::optional<ScatterSample> sample_lambertian(const Color& albedo, const Surface& s, const Vec3& out,
                                                      const Random3& random) {
    const Vec3 in = Frame(s.shading_normal).to_world(sample_cosine_hemisphere(random.x, random.y));
    const double pdf = value_lambertian(albedo, s, out, in).pdf;
    if (!(pdf > 0)) return std::nullopt;
    return ScatterSample{.direction = in, .weight = albedo, .pdf = pdf};
}

}  // namespace limn::bsdf
