#include "limn/scene/material/normal_map.h"

#include <utility>

#include "bsdf/bent_normal.h"
#include "bsdf/lobe.h"
#include "math/require.h"
#include "scene/material/details.h"

namespace limn {

NormalMap::NormalMap(std::shared_ptr<const Material> material, std::shared_ptr<const Texture> normals)
    : material_(std::move(material)), normals_(std::move(normals)) {
    require(material_ != nullptr, "NormalMap: material must not be null");
    require(normals_ != nullptr, "NormalMap: texture must not be null");
    RecordSink sink;
    const MaterialRecord record = material_->lower(sink);
    folds_ = record.lobe != nullptr && record.lobe->one_sided;
}

Surface NormalMap::bent(const Surface& s, const Vec3& out) const {
    Surface result = s;
    result.shading_normal = bsdf::bent_normal(s, out, normals_->value(s));
    if (folds_) result.normal = result.shading_normal;
    return result;
}

std::optional<ScatterSample> NormalMap::sample(const Surface& s, const Vec3& out, const Random3& random) const {
    std::optional<ScatterSample> sample = material_->sample(bent(s, out), out, random);
    if (!folds_ || !sample) return sample;
    if (bsdf::is_below(s.normal, sample->direction)) sample->direction = bsdf::mirrored_at(s.normal, sample->direction);
    if (sample->pdf == 0) return sample;
    const ScatterValue f = value(s, out, sample->direction);
    if (is_black(f.value) || !(f.pdf > 0)) return std::nullopt;
    return ScatterSample{.direction = sample->direction, .weight = f.value / f.pdf, .pdf = f.pdf};
}

ScatterValue NormalMap::value(const Surface& s, const Vec3& out, const Vec3& in) const {
    const Surface around = bent(s, out);
    if (!folds_) return material_->value(around, out, in);
    if (bsdf::is_below(s.normal, in)) return {};
    const ScatterValue a = material_->value(around, out, in);
    const ScatterValue b = material_->value(around, out, bsdf::mirrored_at(s.normal, in));
    return {.value = a.value + b.value, .pdf = a.pdf + b.pdf};
}

MaterialRecord NormalMap::lower(RecordSink& sink) const {
    MaterialRecord record = material_->lower(sink);
    MaterialDetails details = details_of(record);
    require(details.normal_map == TextureId::none, "NormalMap: the material must not be a NormalMap");
    details.normal_map = lower_texture(sink, normals_);
    details.tangents = true;
    record.details = std::make_shared<const MaterialDetails>(details);
    return record;
}

}  // namespace limn
