/// \file
/// Images as textures.
#pragma once

#include "limn/image/image.h"
#include "limn/scene/texture/texture.h"

namespace limn {

/// Options of an ImageTexture.
struct ImageTextureOptions {
    Filter filter = Filter::bilinear;  ///< interpolation between texels
    Wrap wrap = Wrap::repeat;          ///< lookup at coordinates outside [0, 1]
};

/// An image over the unit square of texture coordinates. u points to the right and v upward. (0, 0) is the lower left
/// corner. In an image of W x H texels, column i from the left covers u in [i/W, (i+1)/W), and row j from the top
/// covers 1-v in [j/H, (j+1)/H). The edge u = 1 belongs to the last column, the edge v = 0 to the last row. A NaN
/// coordinate counts as 0.
class ImageTexture final : public Texture {
public:
    /// \param image linear colours, in [0, 1] as an albedo, at least 0 as a radiance
    ///
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
