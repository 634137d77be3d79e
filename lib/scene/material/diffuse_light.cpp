#include "limn/scene/material/diffuse_light.h"

#include <utility>

#include "limn/scene/texture/solid.h"
#include "math/require.h"

namespace limn {

DiffuseLight::DiffuseLight(const Color& radiance, Sides sides) : sides_(sides) {
    require(is_radiance(radiance), "DiffuseLight: radiance must be finite and not negative");
    radiance_ = std::make_shared<SolidColor>(radiance);
}

DiffuseLight::DiffuseLight(std::shared_ptr<const Texture> radiance, Sides sides)
    : radiance_(std::move(radiance)), sides_(sides) {
    require(radiance_ != nullptr, "DiffuseLight: radiance texture must not be null");
}

Color DiffuseLight::emitted(const Surface& s) const {
    return emits_on(sides_, s.front_face) ? radiance_->value(s) : Color{};
}

std::optional<ScatterSample> DiffuseLight::sample(const Surface&, const Vec3&, const Random3&) const {
    return std::nullopt;
}

MaterialRecord DiffuseLight::lower(RecordSink& sink) const {
    return {.kind = "diffuse-light", .emission = lower_texture(sink, radiance_), .sides = sides_};
}

}  // namespace limn
