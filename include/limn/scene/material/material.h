/// \file
/// The interface of every material.
#pragma once

#include <memory>
#include <optional>

#include "limn/math/surface.h"
#include "limn/records/record_sink.h"
#include "limn/scene/texture/texture.h"

namespace limn {

/// Describes how a surface scatters and emits light. All directions are unit vectors in world space that point away
/// from the surface. `out` points back along the path.
///
/// - A subclass that is specular overrides `sample` alone, and its pdf is 0. Any other subclass overrides `value` too.
/// - `sample` and `value` describe the same function: weight == value / pdf.
/// - A mixture of a specular and a diffuse or glossy part chooses one of them in `sample`. The weight of the specular
///   part is divided by the probability of choosing it. `value` returns f |cos| of the other part. Its pdf is
///   multiplied by the probability of choosing that part.
/// - Implementations are immutable and thread-safe. They use no random numbers except those in `random`.
///
/// docs/extending.md works out an example.
class Material {
public:
    virtual ~Material() = default;

    /// Returns the radiance that the surface emits towards the viewer. The default is black.
    virtual Color emitted(const Surface&) const { return {}; }

    /// Draws a scattered direction from three uniform numbers in [0, 1). Returns std::nullopt if the light is absorbed.
    virtual std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& random) const = 0;

    /// Returns f |cos| for the given directions, and the pdf per solid angle with which `sample` draws `in`. Both are
    /// zero for a specular material, which is the default.
    virtual ScatterValue value(const Surface&, const Vec3& /*out*/, const Vec3& /*in*/) const { return {}; }

    /// Returns the record from which compile() makes the compiled material. The default describes a user-defined
    /// material: the compiled scene calls the virtual functions above.
    virtual MaterialRecord lower(RecordSink& sink) const;
};

/// Returns the id of `material` in `sink`, or MaterialId::none for null. Calls Material::lower the first time only.
MaterialId lower_material(RecordSink& sink, const std::shared_ptr<const Material>& material);

/// Returns a reference through which the virtual functions of `material` are called, or a reference to no material for
/// null. The reference doesn't own the material.
MaterialRef material_ref(const Material* material);

}  // namespace limn
