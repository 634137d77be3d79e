/// \file
/// A material for matte surfaces.
#pragma once

#include "limn/scene/material/material.h"

namespace limn {

/// The ideal diffuse reflector, f = albedo / pi, on both sides. Light that an interpolated shading normal would scatter
/// below the geometric surface is absorbed (Veach, Robust Monte Carlo Methods for Light Transport Simulation, 1997,
/// section 5.3).
class Lambertian final : public Material {
public:
    /// \param albedo in [0, 1], or a texture
    ///
    /// \throws ArgumentError if the albedo is outside [0, 1], or the texture is null
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
