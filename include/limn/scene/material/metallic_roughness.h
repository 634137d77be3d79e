/// \file
/// The material model of glTF and of most painting programs.
#pragma once

#include "limn/scene/material/material.h"

namespace limn {

/// The metallic-roughness model of glTF 2.0 (Khronos, 2021, section 3.9.2 and appendix B). It mixes two surfaces of the
/// same roughness:
///
/// - a metal, which reflects the base colour by Schlick's approximation
/// - a diffuse surface of the base colour under a clear coat
///
/// The formulas of the appendix lose energy. limn adds multiple scattering between microfacets as in RoughConductor,
/// and uses the coat and the base of Plastic with Fresnel's equations. A white base colour then returns all light, to
/// within 1e-3, for angles of up to 85 degrees from the normal. The model is reciprocal. Light that an interpolated
/// shading normal would scatter below the geometric surface is absorbed.
class MetallicRoughness final : public Material {
public:
    /// The parameters of the lobe. N is double, or a vector of doubles.
    template <class N>
    struct Parameters {
        N index;      ///< index of refraction of the coat over that of the outside
        N metallic;   ///< share of the metal, or the factor of the texture's blue
        N roughness;  ///< roughness, or the factor of the texture's green
    };

    /// Makes a material of constant metallic and roughness. A roughness below 0.001 counts as 0.001, so no
    /// MetallicRoughness is perfectly smooth. RoughConductor and Plastic can be.
    ///
    /// \param base_color reflectance of the metal at normal incidence and albedo of the diffuse base, in [0, 1], or a
    /// texture
    /// \param metallic share of the metal in the mixture, in [0, 1]
    /// \param roughness in [0, 1], see Roughness
    /// \param index index of refraction of the coat over that of the outside, at least 1
    ///
    /// \throws ArgumentError if an argument is outside its range or not finite, or a texture is null
    ///@{
    MetallicRoughness(const Color& base_color, double metallic, double roughness, double index = 1.5);
    MetallicRoughness(std::shared_ptr<const Texture> base_color, double metallic, double roughness, double index = 1.5);
    ///@}
    /// Makes a material whose metallic and roughness vary over the surface. The other arguments are as above.
    ///
    /// \param metallic_roughness a texture whose green is multiplied by `roughness` and whose blue is multiplied by
    /// `metallic`. The products are clamped to [0, 1]. Red is not used.
    ///
    /// \throws ArgumentError as above
    MetallicRoughness(std::shared_ptr<const Texture> base_color, std::shared_ptr<const Texture> metallic_roughness,
                      double metallic = 1, double roughness = 1, double index = 1.5);
    std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& random) const override;
    ScatterValue value(const Surface& s, const Vec3& out, const Vec3& in) const override;
    MaterialRecord lower(RecordSink& sink) const override;

private:
    std::shared_ptr<const Texture> base_color_, metallic_roughness_;  // metallic_roughness_ may be null
    Parameters<double> parameters_;
    std::shared_ptr<const bsdf::AlbedoTable> albedo_table_, coat_albedo_table_;  // by roughness
};

}  // namespace limn
