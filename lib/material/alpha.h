// What microfacets were given, checked.
#pragma once

#include <memory>
#include <string>

#include "limn/material/roughness.h"
#include "limn/records.h"

namespace limn {

struct Alphas {
    double x, y;  // both 0: smooth
};

// Roughnesses whose alphas are below bsdf::kLeastAlpha are none.
Alphas checked_alphas(const Roughness& r, const std::string& material);

// \param eta see bsdf::albedo_of
std::shared_ptr<const bsdf::AlbedoTable> albedo_table_of(const Alphas& alpha, double eta);

}  // namespace limn
