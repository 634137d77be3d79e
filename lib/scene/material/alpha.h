// Functions for materials with microfacets.
#pragma once

#include <memory>
#include <string>

#include "limn/records/records.h"
#include "limn/scene/material/roughness.h"

namespace limn {

// The alphas of the distribution of normals. Both are 0 if the surface is smooth.
struct Alphas {
    double x, y;
};

// Returns the squares of roughnesses. The surface is smooth if both are below bsdf::kLeastAlpha. If one of them is, it
// is raised to that. \param material name of the material, for the message
Alphas checked_alphas(const Roughness& r, const std::string& material);

// Returns bsdf::albedo_of() with alphas of at least bsdf::kLeastAlpha.
std::shared_ptr<const bsdf::AlbedoTable> albedo_table_of(double alpha_x, double alpha_y, double eta);
// Returns bsdf::albedo_by_roughness(). Tables that exist at the same time are shared, since a model has hundreds of
// materials of one index. Thread-safe.
std::shared_ptr<const bsdf::AlbedoTable> albedo_table_by_roughness(double eta);

}  // namespace limn
