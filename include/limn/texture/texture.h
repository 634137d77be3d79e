/// \file
/// The interface of every texture.
#pragma once

#include <memory>

#include "limn/core/color.h"
#include "limn/core/surface.h"
#include "limn/record_sink.h"

namespace limn {

/// A colour that varies over a surface or through space. Implementations are immutable and thread-safe. A subclass
/// needs `value` alone; the built-in ones also say how to pack themselves.
class Texture {
public:
    virtual ~Texture() = default;

    /// Pure. The colour at `s.position` (world space) or `s.uv`. Linear BT.709; reflectances in [0, 1], radiances >= 0.
    virtual Color value(const Surface& s) const = 0;

    /// The default gives a record of a user-defined texture, through which the compiled scene calls `value`.
    virtual TextureRecord lower(RecordSink& sink) const;
};

/// The id of `texture` in `sink`, lowered the first time; none for null.
TextureId lower_texture(RecordSink& sink, const std::shared_ptr<const Texture>& texture);

}  // namespace limn
