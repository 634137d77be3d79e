// What microfacets were given, checked.
#pragma once

#include <memory>
#include <string>

#include "limn/records/records.h"
#include "limn/scene/material/roughness.h"

namespace limn {

struct Alphas {
    double x, y;  // both 0: smooth
};

// Smooth where both alphas are below bsdf::kLeastAlpha; one alone is raised to it.
Alphas checked_alphas(const Roughness& r, const std::string& material);

// \param eta see bsdf::albedo_of
std::shared_ptr<const bsdf::AlbedoTable> albedo_table_of(const Alphas& alpha, double eta);
// One for all who ask at the same time: a model has hundreds of materials of one index. \param eta see
// bsdf::albedo_by_roughness
std::shared_ptr<const bsdf::AlbedoTable> albedo_table_by_roughness(double eta);

}  // namespace limn
