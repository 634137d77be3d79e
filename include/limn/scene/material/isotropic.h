/// \file
/// The phase function of a medium.
#pragma once

#include "limn/scene/material/material.h"

namespace limn {

/// Scatters equally into all directions: albedo / (4 pi). A ConstantMedium creates one from its albedo. On a surface it
/// ignores the normal, and its value contains no cosine.
class Isotropic final : public Material {
public:
    /// \param albedo in [0, 1], or a texture
    ///
    /// \throws ArgumentError if the albedo is outside [0, 1], or the texture is null
    ///@{
    explicit Isotropic(const Color& albedo);
    explicit Isotropic(std::shared_ptr<const Texture> albedo);
    ///@}
    std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& random) const override;
    ScatterValue value(const Surface& s, const Vec3& out, const Vec3& in) const override;
    MaterialRecord lower(RecordSink& sink) const override;

private:
    std::shared_ptr<const Texture> albedo_;
};

}  // namespace limn
