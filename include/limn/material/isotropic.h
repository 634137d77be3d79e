/// \file
/// The phase function of a medium.
#pragma once

#include "limn/material/material.h"

namespace limn {

/// Scatters into all directions alike, albedo / (4 pi): the phase function of a ConstantMedium. On a surface there is
/// no cosine.
class Isotropic final : public Material {
public:
    /// \throws ArgumentError if the albedo is outside [0, 1]; if the texture is null
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
