/// \file
/// Bumps that a picture tells.
#pragma once

#include "limn/material/material.h"

namespace limn {

/// Another material around normals that a texture bends. Its red, green and blue, from 0 to 1, are the coordinates from
/// -1 to 1 along Surface::dp_du, across it towards dp_dv, and along the shading normal (whose sign is not used), as in
/// glTF; where the shape has no dp_du the normal is not bent.
///
/// What limn's own materials reflect is not lost where the normal is bent: it is turned into view where it faces away,
/// and what is reflected below the geometric surface leaves as if mirrored there, which is the tangent facet of
/// Schüssler, Heitz, Hanika and Dachsbacher, Microfacet-based Normal Mapping for Robust Monte Carlo Path Tracing,
/// SIGGRAPH Asia 2017. Without that a white diffuse surface loses (1 - cos) / 2 where it is bent: 7 % at 30 degrees, a
/// quarter at 60. Light through a Dielectric or a RoughDielectric, or scattered by a user-defined material, is absorbed
/// there.
class NormalMap final : public Material {
public:
    /// \throws ArgumentError if the material or the texture is null; a NormalMap of a NormalMap is refused by compile()
    NormalMap(std::shared_ptr<const Material> material, std::shared_ptr<const Texture> normals);
    Color emitted(const Surface& s) const override { return material_->emitted(s); }
    std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& random) const override;
    ScatterValue value(const Surface& s, const Vec3& out, const Vec3& in) const override;
    MaterialRecord lower(RecordSink& sink) const override;

private:
    Surface bent(const Surface& s, const Vec3& out) const;

    std::shared_ptr<const Material> material_;
    std::shared_ptr<const Texture> normals_;
    bool folds_;  // what is reflected below the surface
};

}  // namespace limn
