/// \file
/// A material for surfaces with holes: leaves, fences, worn cloth.
#pragma once

#include "limn/scene/material/material.h"

namespace limn {

/// Wraps another material and gives it an opacity. The opacity is the share of the light that the surface stops. The
/// wrapped material scatters this share. The rest of the light goes straight on, as if there were no surface.
///
/// - Renders apply the opacity to all rays, shadow rays included.
/// - Queries of a CompiledScene ignore it and report the whole surface.
/// - It has no effect on a user-defined shape.
/// - compile() throws ArgumentError if one AlphaMask wraps another.
class AlphaMask final : public Material {
public:
    /// \param opacity a texture whose red component, clamped to [0, 1], is the opacity
    /// \param cutoff if above 0, the surface stops all light where the opacity is at least `cutoff`, and none elsewhere
    ///
    /// \throws ArgumentError if the material or the texture is null, or the cutoff is not in [0, 1]
    AlphaMask(std::shared_ptr<const Material> material, std::shared_ptr<const Texture> opacity, double cutoff = 0);
    /// Makes a mask of constant opacity.
    ///
    /// \throws ArgumentError if the material is null, or the opacity is not in [0, 1]
    AlphaMask(std::shared_ptr<const Material> material, double opacity);
    Color emitted(const Surface& s) const override { return material_->emitted(s); }
    std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& random) const override;
    ScatterValue value(const Surface& s, const Vec3& out, const Vec3& in) const override;
    MaterialRecord lower(RecordSink& sink) const override;

private:
    std::shared_ptr<const Material> material_;
    std::shared_ptr<const Texture> opacity_;
    double cutoff_;
};

}  // namespace limn
