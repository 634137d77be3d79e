/// \file
/// The interface of every texture.
#pragma once

#include <memory>

#include "limn/math/color.h"
#include "limn/math/surface.h"
#include "limn/records/record_sink.h"

namespace limn {

/// A colour that varies over a surface or in space. Implementations are immutable and thread-safe. A subclass needs to
/// override `value` alone.
class Texture {
public:
    virtual ~Texture() = default;

    /// Returns the linear BT.709 colour at a point, as a function of `s.position` (in world space) or `s.uv`. The
    /// function is pure. The colour is in [0, 1] as an albedo, and at least 0 as a radiance; limn doesn't clamp it. It
    /// is finite for every position and uv, NaN included.
    virtual Color value(const Surface& s) const = 0;

    /// Returns the record from which compile() makes the compiled texture. The default describes a user-defined
    /// texture: the compiled scene calls `value`.
    virtual TextureRecord lower(RecordSink& sink) const;
};

/// Returns the id of `texture` in `sink`, or TextureId::none for null. Calls Texture::lower the first time only.
TextureId lower_texture(RecordSink& sink, const std::shared_ptr<const Texture>& texture);

}  // namespace limn
