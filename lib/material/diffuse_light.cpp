#include "limn/material/diffuse_light.h"

#include <utility>

#include "core/require.h"
#include "limn/texture/solid.h"

namespace limn {

DiffuseLight::DiffuseLight(const Color& radiance) {
    require(is_radiance(radiance), "DiffuseLight: radiance must be finite and not negative");
    radiance_ = std::make_shared<SolidColor>(radiance);
}

DiffuseLight::DiffuseLight(std::shared_ptr<const Texture> radiance) : radiance_(std::move(radiance)) {
    require(radiance_ != nullptr, "DiffuseLight: radiance texture must not be null");
}

Color DiffuseLight::emitted(const Surface& s) const { return radiance_->value(s); }

std::optional<ScatterSample> DiffuseLight::sample(const Surface&, const Vec3&, const Random3&) const {
    return std::nullopt;
}

MaterialRecord DiffuseLight::lower(RecordSink& sink) const {
    MaterialRecord record;
    record.kind = "diffuse-light";
    record.emission = lower_texture(sink, radiance_);
    return record;
}

}  // namespace limn
