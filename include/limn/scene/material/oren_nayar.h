/// \file
/// A material for rough matte surfaces: clay, plaster, the Moon.
#pragma once

#include "limn/scene/material/material.h"

namespace limn {

/// A diffuse reflector of microfacets that shadow and light each other: Oren and Nayar's model in the form of
/// Portsmouth, Kutz and Hill (EON: A Practical Energy-Preserving Rough Diffuse BRDF, 2024). A rough ball stays bright
/// towards its edge. The model is reciprocal. An albedo of 1 loses no light at any roughness or angle. Light that an
/// interpolated shading normal would scatter below the geometric surface is absorbed.
class OrenNayar final : public Material {
public:
    /// The parameters of the lobe. N is double, or a vector of doubles.
    template <class N>
    struct Parameters {
        N roughness;  ///< in [0, 1]
    };

    /// \param albedo albedo of a facet, in [0, 1], or a texture
    /// \param roughness in [0, 1]; 0 is Lambertian
    ///
    /// \throws ArgumentError if the albedo or the roughness is outside [0, 1], or the texture is null
    ///@{
    OrenNayar(const Color& albedo, double roughness);
    OrenNayar(std::shared_ptr<const Texture> albedo, double roughness);
    ///@}
    std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& random) const override;
    ScatterValue value(const Surface& s, const Vec3& out, const Vec3& in) const override;
    MaterialRecord lower(RecordSink& sink) const override;

private:
    std::shared_ptr<const Texture> albedo_;
    Parameters<double> parameters_;
};

}  // namespace limn
