/// \file
/// Matte surfaces.
#pragma once

#include "limn/material/material.h"

namespace limn {

/// The ideal diffuse reflector, f = albedo / pi, on both sides. Around an interpolated normal, what lies below the
/// geometric surface is absorbed (Veach, Robust Monte Carlo Methods for Light Transport Simulation, 1997, section 5.3).
class Lambertian final : public Material {
public:
    /// \throws ArgumentError if the albedo is negative, over 1 or not finite; if the texture is null
    ///@{
    explicit Lambertian(const Color& albedo);
    explicit Lambertian(std::shared_ptr<const Texture> albedo);
    ///@}
    std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& random) const override;
    ScatterValue value(const Surface& s, const Vec3& out, const Vec3& in) const override;
    MaterialRecord lower(RecordSink& sink) const override;

private:
    std::shared_ptr<const Texture> albedo_;
};

}  // namespace limn
