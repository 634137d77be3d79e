#include "limn/scene/texture/checker.h"

#include <cmath>
#include <utility>

#include "bsdf/checker.h"
#include "limn/scene/texture/solid.h"
#include "math/require.h"

namespace limn {

Checker::Checker(double scale, const Color& even, const Color& odd)
    : Checker(scale, std::make_shared<SolidColor>(even), std::make_shared<SolidColor>(odd)) {}

Checker::Checker(double scale, std::shared_ptr<const Texture> even, std::shared_ptr<const Texture> odd)
    : scale_(scale), even_(std::move(even)), odd_(std::move(odd)) {
    require(std::isfinite(scale) && scale > 0, "Checker: scale must be positive and finite");
    require(even_ && odd_, "Checker: even and odd textures must not be null");
}

Color Checker::value(const Surface& s) const {
    return (pattern::checker_is_even(s.position, scale_) ? even_ : odd_)->value(s);
}

TextureRecord Checker::lower(RecordSink& sink) const {
    TextureRecord record;
    record.kind = TextureKind::checker;
    record.scale = scale_;
    record.even = lower_texture(sink, even_);
    record.odd = lower_texture(sink, odd_);
    return record;
}

}  // namespace limn
