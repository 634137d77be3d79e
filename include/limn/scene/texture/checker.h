/// \file
/// A checkerboard in three dimensions.
#pragma once

#include "limn/scene/texture/texture.h"

namespace limn {

/// A checkerboard of cubes with sides of length `scale` in world space. A cell is even if the sum of floor(x/scale),
/// floor(y/scale) and floor(z/scale) is even. A coordinate that is NaN, or at least 2^53 cells from the origin, counts
/// as even.
class Checker final : public Texture {
public:
    /// \param scale side of a cell, in world units
    /// \param even,odd colours of the even and odd cells, at least 0, or textures
    ///
    /// \throws ArgumentError if the scale is not positive and finite, a component of a colour is negative or not
    /// finite, or a texture is null
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
