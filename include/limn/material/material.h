/// \file
/// The interface of every material.
#pragma once

#include <memory>
#include <optional>

#include "limn/core/surface.h"
#include "limn/record_sink.h"
#include "limn/texture/texture.h"

namespace limn {

/// How a surface scatters and emits light. All directions are unit vectors in world space that point away from the
/// surface; `out` is where the path came from. Implementations are immutable and thread-safe; they draw no random
/// numbers of their own. A subclass needs `sample` alone if it is specular (pdf 0), else also `value`, which must
/// describe the same function: weight == value / pdf. A mixture draws between a specular part and the rest; `value` and
/// the pdf, times the probability of that choice, then describe the rest. docs/extending.md works out an example.
class Material {
public:
    virtual ~Material() = default;

    /// Radiance that leaves towards the viewer.
    virtual Color emitted(const Surface&) const { return {}; }

    /// Draws a direction from numbers in [0, 1); std::nullopt if the light is absorbed.
    virtual std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& random) const = 0;

    /// f |cos| and the density with which `sample` draws `in`; zero for specular materials.
    virtual ScatterValue value(const Surface&, const Vec3& /*out*/, const Vec3& /*in*/) const { return {}; }

    /// The default gives a record of a user-defined material, through which the compiled scene calls these functions.
    virtual MaterialRecord lower(RecordSink& sink) const;
};

/// The id of `material` in `sink`, lowered the first time; none for null.
MaterialId lower_material(RecordSink& sink, const std::shared_ptr<const Material>& material);

/// A reference through which a described material is called as it is; none for null. Not owning.
MaterialRef material_ref(const Material* material);

}  // namespace limn
