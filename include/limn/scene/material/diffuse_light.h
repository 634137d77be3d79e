/// \file
/// A material for area lights.
#pragma once

#include "limn/records/records.h"
#include "limn/scene/material/material.h"

namespace limn {

/// Emits the same radiance in every direction, on both sides or one, and scatters nothing. Light sampling finds it on
/// spheres, triangles, quads, disks and meshes. Paths find it by scattering alone if
///
/// - its texture, or the opacity of an AlphaMask around it, is user-defined or contains a user-defined texture
/// - it is on a sphere and has an AlphaMask around it
/// - it is on a user-defined shape
///
/// docs/architecture.md, "One path", lists the remaining cases: some instanced emitters and some textured spheres.
class DiffuseLight final : public Material {
public:
    /// \param radiance emitted radiance in W / (sr m^2), at least 0, or a texture
    /// \param sides sides of the surface that emit
    ///
    /// \throws ArgumentError if a component is negative or not finite, or the texture is null
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
