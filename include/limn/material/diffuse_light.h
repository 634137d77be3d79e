/// \file
/// Lamps.
#pragma once

#include "limn/material/material.h"
#include "limn/records.h"

namespace limn {

/// Emits the same radiance in every direction, on both sides or one, and scatters nothing. On a sphere, triangle, quad,
/// disk or mesh it is sampled as a light, unless its texture, or that of an AlphaMask around it, is user-defined, or it
/// is on a sphere with an AlphaMask (docs/architecture.md, "One path", also for instances). Elsewhere paths find it by
/// scattering.
class DiffuseLight final : public Material {
public:
    /// \throws ArgumentError if a component is negative or not finite; if the texture is null
    ///@{
    explicit DiffuseLight(const Color& radiance, Sides sides = Sides::both);
    explicit DiffuseLight(std::shared_ptr<const Texture> radiance, Sides sides = Sides::both);
    ///@}
    Color emitted(const Surface& s) const override;
    std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& random) const override;
    MaterialRecord lower(RecordSink& sink) const override;

private:
    std::shared_ptr<const Texture> radiance_;
    Sides sides_;
};

}  // namespace limn
