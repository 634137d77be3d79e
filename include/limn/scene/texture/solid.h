/// \file
/// The texture of one colour.
#pragma once

#include "limn/scene/texture/texture.h"

namespace limn {

/// A texture that has the same colour everywhere.
class SolidColor final : public Texture {
public:
    /// \param color in [0, 1] as an albedo, at least 0 as a radiance
    ///
    /// \throws ArgumentError if a component is negative or not finite
    explicit SolidColor(const Color& color);
    Color value(const Surface&) const override { return color_; }
    TextureRecord lower(RecordSink& sink) const override;

private:
    Color color_;
};

}  // namespace limn
