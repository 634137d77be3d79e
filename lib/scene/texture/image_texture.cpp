#include "limn/scene/texture/image_texture.h"

#include <utility>

#include "bsdf/image_lookup.h"
#include "math/require.h"

namespace limn {

ImageTexture::ImageTexture(Image image, ImageTextureOptions options)
    : ImageTexture(std::make_shared<const Image>(std::move(image)), options) {}

ImageTexture::ImageTexture(std::shared_ptr<const Image> image, ImageTextureOptions options)
    : image_(std::move(image)), options_(options) {
    require(image_ && !image_->empty(), "ImageTexture: image must not be empty");
}

Color ImageTexture::value(const Surface& s) const {
    return pattern::lookup_image(*image_, s.uv, options_.filter, options_.wrap);
}

TextureRecord ImageTexture::lower(RecordSink& sink) const {
    TextureRecord record;
    record.kind = TextureKind::image;
    record.filter = options_.filter;
    record.wrap = options_.wrap;
    record.data = sink.image(image_);
    return record;
}

}  // namespace limn
