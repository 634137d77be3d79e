#include "limn/material/metal.h"

#include "bsdf/metal.h"
#include "material/albedo.h"

namespace limn {

namespace {

double checked_fuzz(double fuzz) {
    require(fuzz >= 0 && fuzz <= 1, "Metal: fuzz must be in [0, 1]");
    return fuzz;
}

}  // namespace

Metal::Metal(const Color& albedo, double fuzz) : albedo_(checked_albedo(albedo, "Metal")), fuzz_(checked_fuzz(fuzz)) {}

Metal::Metal(std::shared_ptr<const Texture> albedo, double fuzz)
    : albedo_(checked_albedo(std::move(albedo), "Metal")), fuzz_(checked_fuzz(fuzz)) {}

std::optional<ScatterSample> Metal::sample(const Surface& s, const Vec3& out, const Random3& random) const {
    return bsdf::sample_metal(albedo_->value(s), fuzz_, s, out, random);
}

ScatterValue Metal::value(const Surface& s, const Vec3& out, const Vec3& in) const {
    return bsdf::value_metal(albedo_->value(s), fuzz_, s, out, in);
}

MaterialRecord Metal::lower(RecordSink& sink) const {
    MaterialRecord record;
    record.kind = MaterialKind::metal;
    record.texture = lower_texture(sink, albedo_);
    record.parameter = fuzz_;
    return record;
}

}  // namespace limn
