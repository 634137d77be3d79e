// The isotropic phase function, albedo / (4 pi); no cosine.
#pragma once

#include <optional>

#include "limn/core/surface.h"
#include "limn/core/warp.h"

namespace limn::bsdf {

inline ScatterValue value_isotropic(const Color& albedo) {
    return {.value = albedo * pdf_uniform_sphere(), .pdf = pdf_uniform_sphere()};
}

inline std::optional<ScatterSample> sample_isotropic(const Color& albedo, const Random3& random) {
    return ScatterSample{
        .direction = sample_uniform_sphere(random.x, random.y), .weight = albedo, .pdf = pdf_uniform_sphere()};
}

}  // namespace limn::bsdf
