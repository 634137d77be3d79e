/// \file
/// Rough matte surfaces: clay, plaster, the Moon.
#pragma once

#include "limn/material/material.h"

namespace limn {

/// A diffuse reflector of microfacets that shadow and light each other, which keeps its brightness towards the edge of
/// a ball: Oren and Nayar's model in the form of Portsmouth, Kutz and Hill (EON: A Practical Energy-Preserving Rough
/// Diffuse BRDF, 2024). It is reciprocal, and an albedo of 1 loses no light at any roughness and angle. Around an
/// interpolated normal, what lies below the geometric surface is absorbed.
class OrenNayar final : public Material {
public:
    /// \param albedo what a facet reflects, in [0, 1], or a texture
    /// \param roughness in [0, 1]; 0 is Lambertian
    ///
    /// \throws ArgumentError if the albedo is negative, over 1 or not finite, the texture is null, or the roughness is
    /// not in [0, 1]
    ///@{
    OrenNayar(const Color& albedo, double roughness);
    OrenNayar(std::shared_ptr<const Texture> albedo, double roughness);
    ///@}
    std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& random) const override;
    ScatterValue value(const Surface& s, const Vec3& out, const Vec3& in) const override;
    MaterialRecord lower(RecordSink& sink) const override;

private:
    std::shared_ptr<const Texture> albedo_;
    double roughness_;
};

}  // namespace limn
