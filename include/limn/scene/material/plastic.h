/// \file
/// A material for plastic, varnish and glazed clay.
#pragma once

#include "limn/scene/material/material.h"
#include "limn/scene/material/roughness.h"

namespace limn {

/// A diffuse base under a clear coat, which is smooth or rough (Kelemen and Szirmay-Kalos, A Microfacet Based Coupled
/// Specular-Matte BRDF Model with Importance Sampling, Eurographics 2001). The coat consists of microfacets (see
/// RoughConductor) that reflect by Fresnel's equations. Light that the coat doesn't reflect is scattered diffusely by
/// the base and leaves through the coat. An albedo of 1 loses no light, to within 1e-3. The model is reciprocal. Light
/// that an interpolated shading normal would scatter below the geometric surface is absorbed.
class Plastic final : public Material {
public:
    /// The parameters of the lobe. N is double, or a vector of doubles.
    template <class N>
    struct Parameters {
        N index;    ///< index of refraction of the coat over that of the outside
        N alpha_x;  ///< square of the roughness along Surface::dp_du; 0: smooth
        N alpha_y;  ///< square of the roughness perpendicular to it
    };

    /// \param albedo share of the light entering the coat that leaves it again, in [0, 1], or a texture
    /// \param roughness roughness of the coat, see Roughness
    /// \param index index of refraction of the coat over that of the outside, at least 1
    /// \param specular factor of the coat's reflection, in [0, 1], or a texture; 1 is physical
    ///
    /// \throws ArgumentError if an argument is outside its range or not finite, or a texture is null
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
    Parameters<double> parameters_;
    std::shared_ptr<const bsdf::AlbedoTable> albedo_table_;
};

}  // namespace limn
