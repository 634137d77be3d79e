/// \file
/// What glTF and most painting programs call a material.
#pragma once

#include "limn/material/material.h"

namespace limn {

/// The metallic-roughness model of glTF 2.0 (Khronos, 2021, section 3.9.2 and appendix B): a mixture of a metal, which
/// reflects the base colour by Schlick's approximation, and of a diffuse base colour under a clear coat, both of the
/// same roughness. Where the appendix lets light vanish, none does: facets scatter more than once as in a
/// RoughConductor, and the coat and what is below are those of Plastic, by Fresnel's equations; so a white one returns
/// all light, to 1e-3 up to angles of 85 degrees, and light goes both ways alike. Around an interpolated normal, what
/// lies below the geometric surface is absorbed.
class MetallicRoughness final : public Material {
public:
    /// A roughness below 0.001 counts as 0.001, as a picture may hold any: alpha, its square, is at least 1e-6. Metal
    /// and Plastic can be smooth.
    ///
    /// \param base_color what metal reflects at normal incidence, and the albedo of the rest; in [0, 1], or a texture
    /// \param metallic 0 plastic, 1 metal; between both a mixture
    /// \param roughness in [0, 1], see Roughness
    /// \param index of the coat over that of the outside, at least 1
    ///
    /// \throws ArgumentError if one of these is outside its range or not finite, or a texture is null
    ///@{
    MetallicRoughness(const Color& base_color, double metallic, double roughness, double index = 1.5);
    MetallicRoughness(std::shared_ptr<const Texture> base_color, double metallic, double roughness, double index = 1.5);
    ///@}
    /// Both vary over the surface.
    ///
    /// \param metallic_roughness its green is multiplied by `roughness`, its blue by
    /// `metallic`, and the products are clamped to [0, 1]; red is not used
    MetallicRoughness(std::shared_ptr<const Texture> base_color, std::shared_ptr<const Texture> metallic_roughness,
                      double metallic = 1, double roughness = 1, double index = 1.5);
    std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& random) const override;
    ScatterValue value(const Surface& s, const Vec3& out, const Vec3& in) const override;
    MaterialRecord lower(RecordSink& sink) const override;

private:
    std::shared_ptr<const Texture> base_color_, metallic_roughness_;  // the second one may be null
    double index_;
    std::shared_ptr<const MaterialDetails> details_;  // without the texture
};

}  // namespace limn
