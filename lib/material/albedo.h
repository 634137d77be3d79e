// The albedo that a material was given, checked.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "core/require.h"
#include "limn/texture/solid.h"

namespace limn {

/// \param material its name, for the message
inline std::shared_ptr<const Texture> checked_albedo(const Color& albedo, const std::string& material) {
    require(is_reflectance(albedo), material + ": albedo must be in [0, 1]");
    return std::make_shared<SolidColor>(albedo);
}

inline std::shared_ptr<const Texture> checked_albedo(std::shared_ptr<const Texture> albedo,
                                                     const std::string& material) {
    require(albedo != nullptr, material + ": albedo texture must not be null");
    return albedo;
}

}  // namespace limn
