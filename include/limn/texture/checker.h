/// \file
/// Checkered space.
#pragma once

#include "limn/texture/texture.h"

namespace limn {

/// Space cut into cubes of side `scale` in two textures by turns: parity of floor(x/scale) + floor(y/scale) +
/// floor(z/scale) of the world position. A coordinate from 2^53 cells on, or NaN, counts as even.
class Checker final : public Texture {
public:
    /// \param scale side of a cell, in world units
    /// \param even,odd colours, at least 0, or textures
    ///
    /// \throws ArgumentError if scale is not positive and finite, a colour is negative or not finite, or a texture is
    /// null
    ///@{
    Checker(double scale, const Color& even, const Color& odd);
    Checker(double scale, std::shared_ptr<const Texture> even, std::shared_ptr<const Texture> odd);
    ///@}
    Color value(const Surface& s) const override;
    TextureRecord lower(RecordSink& sink) const override;

private:
    double scale_;
    std::shared_ptr<const Texture> even_, odd_;
};

}  // namespace limn
