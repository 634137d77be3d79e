#include "limn/material/isotropic.h"

#include "bsdf/isotropic.h"
#include "material/albedo.h"

namespace limn {

Isotropic::Isotropic(const Color& albedo) : albedo_(checked_albedo(albedo, "Isotropic")) {}

Isotropic::Isotropic(std::shared_ptr<const Texture> albedo) : albedo_(checked_albedo(std::move(albedo), "Isotropic")) {}

std::optional<ScatterSample> Isotropic::sample(const Surface& s, const Vec3&, const Random3& random) const {
    return bsdf::sample_isotropic(albedo_->value(s), random);
}

ScatterValue Isotropic::value(const Surface& s, const Vec3&, const Vec3&) const {
    return bsdf::value_isotropic(albedo_->value(s));
}

MaterialRecord Isotropic::lower(RecordSink& sink) const {
    MaterialRecord record;
    record.kind = MaterialKind::isotropic;
    record.texture = lower_texture(sink, albedo_);
    return record;
}

}  // namespace limn
