/// \file
/// Plastic, varnish, glazed clay.
#pragma once

#include "limn/material/material.h"
#include "limn/material/roughness.h"

namespace limn {

/// A diffuse surface under a clear coat, smooth or rough. The coat reflects by Fresnel's equations on microfacets (see
/// RoughConductor). What it does not reflect once is scattered diffusely below, and leaves through the coat again, so
/// that an albedo of 1 loses no light (to 1e-3) and light goes both ways alike (Kelemen and Szirmay-Kalos, A Microfacet
/// Based Coupled Specular-Matte BRDF Model with Importance Sampling, Eurographics 2001). Around an interpolated normal,
/// what lies below the geometric surface is absorbed.
class Plastic final : public Material {
public:
    /// \param albedo what is left of the light that enters the coat when it leaves, in [0, 1], or a texture
    /// \param roughness of the coat, see Roughness
    /// \param index of the coat over that of the outside, at least 1
    /// \param specular what the coat's reflection is multiplied by, in [0, 1], or a texture; 1 is physical
    ///
    /// \throws ArgumentError if one of these is outside its range or not finite, or a texture is null
    ///@{
    Plastic(const Color& albedo, const Roughness& roughness, double index = 1.5, const Color& specular = {1, 1, 1});
    Plastic(std::shared_ptr<const Texture> albedo, const Roughness& roughness, double index = 1.5,
            const Color& specular = {1, 1, 1});
    Plastic(std::shared_ptr<const Texture> albedo, const Roughness& roughness, double index,
            std::shared_ptr<const Texture> specular);
    ///@}
    std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& random) const override;
    ScatterValue value(const Surface& s, const Vec3& out, const Vec3& in) const override;
    MaterialRecord lower(RecordSink& sink) const override;

private:
    std::shared_ptr<const Texture> albedo_, specular_;
    double index_;
    std::shared_ptr<const MaterialDetails> details_;  // without the texture
};

}  // namespace limn
