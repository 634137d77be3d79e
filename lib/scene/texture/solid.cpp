#include "limn/scene/texture/solid.h"

#include "math/require.h"

namespace limn {

SolidColor::SolidColor(const Color& color) : color_(color) {
    require(is_radiance(color), "SolidColor: color must be finite and not negative");
}

TextureRecord SolidColor::lower(RecordSink&) const {
    TextureRecord record;
    record.kind = TextureKind::solid;
    record.color = color_;
    return record;
}

}  // namespace limn
