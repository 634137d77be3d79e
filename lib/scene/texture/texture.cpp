#include "limn/scene/texture/texture.h"

namespace limn {

TextureRecord Texture::lower(RecordSink& sink) const {
    sink.identify(dynamic_cast<const Tagged*>(this));
    TextureRecord record;
    record.kind = TextureKind::user_defined;
    record.object = this;
    record.value = [](const Texture& texture, const Surface& s) { return texture.value(s); };
    return record;
}

TextureId lower_texture(RecordSink& sink, const std::shared_ptr<const Texture>& texture) {
    return sink.texture(texture, [&] { return texture->lower(sink); });
}

}  // namespace limn
