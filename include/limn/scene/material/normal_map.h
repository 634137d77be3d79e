/// \file
/// Bumps from an image of normals.
#pragma once

#include "limn/scene/material/material.h"

namespace limn {

/// Wraps another material and bends its shading normal by a texture, in the tangent space of glTF. The texture's
/// components in [0, 1] are mapped to coordinates in [-1, 1]:
///
/// - red: along Surface::dp_du, projected into the plane perpendicular to the shading normal
/// - green: perpendicular to red in that plane, towards Surface::dp_dv
/// - blue: along the shading normal; its sign is ignored
///
/// The normal is not bent if Surface::dp_du is zero. A bent normal whose cosine with the direction to the viewer is
/// below 0.001 is turned towards the viewer, to about this cosine or a larger one.
///
/// Light that limn's opaque materials reflect below the geometric surface isn't lost. It is mirrored at the geometric
/// surface, which models the tangent facet of Schüssler, Heitz, Hanika and Dachsbacher, Microfacet-based Normal Mapping
/// for Robust Monte Carlo Path Tracing, SIGGRAPH Asia 2017. A white diffuse surface whose normal is bent by an angle a
/// would otherwise lose the share (1 - cos a) / 2: 7 % at 30 degrees, 25 % at 60 degrees. Light that a Dielectric, a
/// RoughDielectric or a user-defined material sends to the wrong side is absorbed. compile() throws ArgumentError if
/// one NormalMap wraps another.
class NormalMap final : public Material {
public:
    /// \param normals a texture of normals, linear, not sRGB
    ///
    /// \throws ArgumentError if the material or the texture is null
    NormalMap(std::shared_ptr<const Material> material, std::shared_ptr<const Texture> normals);
    Color emitted(const Surface& s) const override { return material_->emitted(s); }
    std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& random) const override;
    ScatterValue value(const Surface& s, const Vec3& out, const Vec3& in) const override;
    MaterialRecord lower(RecordSink& sink) const override;

private:
    // Returns `s` with the bent shading normal. If `has_tangent_facet_`, its geometric normal is the bent normal too.
    Surface bent(const Surface& s, const Vec3& out) const;

    std::shared_ptr<const Material> material_;
    std::shared_ptr<const Texture> normals_;
    bool has_tangent_facet_;  // true if light that is reflected below the surface is mirrored back
};

}  // namespace limn
