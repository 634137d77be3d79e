/// \file
/// Pictures on surfaces.
#pragma once

#include "limn/image/image.h"
#include "limn/texture/texture.h"

namespace limn {

/// How an ImageTexture reads its image.
struct ImageTextureOptions {
    Filter filter = Filter::bilinear;  ///< between texels
    Wrap wrap = Wrap::repeat;          ///< outside [0, 1]
};

/// An image over the texture coordinates: u to the right, v upward; (0, 0) is the lower left corner. Texel (i, j from
/// the top) covers u in [i/W, (i+1)/W), 1-v in [j/H, (j+1)/H); the far edges u = 1 and v = 0 belong to the last column
/// and row, and `wrap` counts beyond. NaN coordinates read as 0.
class ImageTexture final : public Texture {
public:
    /// \throws ArgumentError if the image is null or empty
    ///@{
    explicit ImageTexture(Image image, ImageTextureOptions options = {});
    explicit ImageTexture(std::shared_ptr<const Image> image, ImageTextureOptions options = {});
    ///@}
    Color value(const Surface& s) const override;
    TextureRecord lower(RecordSink& sink) const override;

private:
    std::shared_ptr<const Image> image_;
    ImageTextureOptions options_;
};

}  // namespace limn
