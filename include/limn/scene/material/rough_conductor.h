/// \file
/// A material for metals.
#pragma once

#include "limn/scene/material/material.h"
#include "limn/scene/material/roughness.h"

namespace limn {

/// The complex index of refraction eta + i k of a conductor, relative to the outside, for each colour component.
struct ComplexIndex {
    /// Each component of eta is above 0. Each component of k is at least 0.
    ///@{
    Color eta, k;
    ///@}
};

/// Metal, smooth or rough. Its microfacets have the distribution of Trowbridge and Reitz (GGX) and the correlated
/// masking of Smith (Heitz, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, JCGT 3(2), 2014).
/// They reflect by Fresnel's equations. Multiple scattering between facets is added after Kulla and Conty (Revisiting
/// Physically Based Shading at Imageworks, 2017). A reflectance of 1 then loses no light at any roughness, to within
/// 1e-3, for angles of up to 85 degrees from the normal. The model is reciprocal. Light that an interpolated shading
/// normal would scatter below the geometric surface is absorbed.
class RoughConductor final : public Material {
public:
    /// The parameters of the lobe. N is double, or a vector of doubles.
    template <class N>
    struct Parameters {
        /// A component of the edge tint.
        ///@{
        N edge_tint_r, edge_tint_g, edge_tint_b;
        ///@}
        N alpha_x;  ///< square of the roughness along Surface::dp_du; 0: smooth
        N alpha_y;  ///< square of the roughness perpendicular to it
    };

    /// Makes a conductor of the given reflectance at normal incidence. The edge tint controls how the reflectance rises
    /// to 1 towards grazing incidence (Gulbrandsen, Artist Friendly Metallic Fresnel, JCGT 3(4), 2014).
    ///
    /// \param reflectance in [0, 1], or a texture
    /// \param roughness see Roughness
    /// \param edge_tint in [0, 1]. At 0 the reflectance rises only near grazing incidence, as without absorption. At 1
    /// it rises much earlier.
    ///
    /// \throws ArgumentError if an argument is outside its range or not finite, or the texture is null
    ///@{
    RoughConductor(const Color& reflectance, const Roughness& roughness, const Color& edge_tint = {});
    RoughConductor(std::shared_ptr<const Texture> reflectance, const Roughness& roughness, const Color& edge_tint = {});
    ///@}
    /// Makes a conductor of the given index of refraction.
    ///
    /// \throws ArgumentError if a component of eta is not above 0, a component of k is negative, one of them is not
    /// finite, or the roughness is outside [0, 1]
    RoughConductor(const ComplexIndex& index, const Roughness& roughness);
    std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& random) const override;
    ScatterValue value(const Surface& s, const Vec3& out, const Vec3& in) const override;
    MaterialRecord lower(RecordSink& sink) const override;

private:
    std::shared_ptr<const Texture> reflectance_;
    Parameters<double> parameters_;
    std::shared_ptr<const bsdf::AlbedoTable> albedo_table_;
};

}  // namespace limn
