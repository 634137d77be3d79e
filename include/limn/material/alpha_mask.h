/// \file
/// Leaves, fences, worn cloth: surfaces with holes.
#pragma once

#include "limn/material/material.h"

namespace limn {

/// Another material where a texture is opaque; elsewhere light passes as if there were no surface. Renders follow it
/// for all rays, those to lamps included; queries of a CompiledScene tell of the whole surface. On a user-defined shape
/// it has no effect. compile() refuses one around another.
class AlphaMask final : public Material {
public:
    /// \param opacity a texture whose red, from 0 to 1, is how much of the light the surface stops
    /// \param cutoff if over 0: it stops all light where its opacity is at least that, and none elsewhere
    ///
    /// \throws ArgumentError if the material or the texture is null, or the cutoff is not in [0, 1]
    AlphaMask(std::shared_ptr<const Material> material, std::shared_ptr<const Texture> opacity, double cutoff = 0);
    /// The same opacity everywhere. \throws ArgumentError if the material is null, or the opacity is not in [0, 1]
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
