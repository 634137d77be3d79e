// Checks of the arguments of materials. \param material name of the material, for the message
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "limn/scene/texture/solid.h"
#include "math/require.h"

namespace limn {

inline std::shared_ptr<const Texture> checked_albedo(const Color& albedo, const std::string& material) {
    require(is_reflectance(albedo), material + ": albedo must be in [0, 1]");
    return std::make_shared<SolidColor>(albedo);
}

inline std::shared_ptr<const Texture> checked_albedo(std::shared_ptr<const Texture> albedo,
                                                     const std::string& material) {
    require(albedo != nullptr, material + ": albedo texture must not be null");
    return albedo;
}

// \param what name of the material and the argument, for the message
inline double checked_share(double share, const std::string& what) {
    require(share >= 0 && share <= 1, what + " must be in [0, 1]");
    return share;
}

}  // namespace limn
