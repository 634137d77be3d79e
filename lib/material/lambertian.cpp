#include "limn/material/lambertian.h"

#include "bsdf/lambertian.h"
#include "material/albedo.h"

namespace limn {

Lambertian::Lambertian(const Color& albedo) : albedo_(checked_albedo(albedo, "Lambertian")) {}

Lambertian::Lambertian(std::shared_ptr<const Texture> albedo)
    : albedo_(checked_albedo(std::move(albedo), "Lambertian")) {}

std::optional<ScatterSample> Lambertian::sample(const Surface& s, const Vec3& out, const Random3& random) const {
    return bsdf::sample_lambertian(albedo_->value(s), s, out, random);
}

ScatterValue Lambertian::value(const Surface& s, const Vec3& out, const Vec3& in) const {
    return bsdf::value_lambertian(albedo_->value(s), s, out, in);
}

MaterialRecord Lambertian::lower(RecordSink& sink) const {
    MaterialRecord record;
    record.kind = MaterialKind::lambertian;
    record.texture = lower_texture(sink, albedo_);
    return record;
}

}  // namespace limn
