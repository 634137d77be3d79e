/// \file
/// Metals.
#pragma once

#include "limn/material/material.h"
#include "limn/material/roughness.h"

namespace limn {

/// The complex index of refraction eta + i k of a conductor, relative to what is outside, by component.
struct ComplexIndex {
    /// eta over 0, k at least 0.
    ///@{
    Color eta, k;
    ///@}
};

/// Metal, smooth or rough: microfacets with the distribution of Trowbridge and Reitz (GGX), the correlated masking of
/// Smith (Heitz, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, JCGT 3(2), 2014), and
/// Fresnel's equations. Light that facets scatter more than once is added (Kulla and Conty, Revisiting Physically Based
/// Shading at Imageworks, 2017): a conductor that reflects all loses no light at any roughness, to 1e-3 up to angles of
/// 85 degrees, and light goes both ways alike. Around an interpolated normal, what lies below the geometric surface is
/// absorbed.
class RoughConductor final : public Material {
public:
    /// By what it reflects at normal incidence, and its edge tint, which says how it gets to reflect all at grazing
    /// incidence: 0 as late as an interface without absorption, 1 much earlier (Gulbrandsen, Artist Friendly Metallic
    /// Fresnel, JCGT 3(4), 2014).
    /// \param reflectance in [0, 1], or a texture
    /// \param roughness see Roughness
    /// \param edge_tint in [0, 1]
    ///
    /// \throws ArgumentError if one of these is outside its range or not finite, or the texture is null
    ///@{
    RoughConductor(const Color& reflectance, const Roughness& roughness, const Color& edge_tint = {});
    RoughConductor(std::shared_ptr<const Texture> reflectance, const Roughness& roughness, const Color& edge_tint = {});
    ///@}
    /// By its index of refraction.
    /// \throws ArgumentError if an eta is not over 0, a k is negative, one is not finite, or the roughness is not in
    /// [0, 1]
    RoughConductor(const ComplexIndex& index, const Roughness& roughness);
    std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& random) const override;
    ScatterValue value(const Surface& s, const Vec3& out, const Vec3& in) const override;
    MaterialRecord lower(RecordSink& sink) const override;

private:
    std::shared_ptr<const Texture> reflectance_;
    std::shared_ptr<const MaterialDetails> details_;
};

}  // namespace limn
