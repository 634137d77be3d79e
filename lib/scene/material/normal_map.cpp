#include "limn/scene/material/normal_map.h"

#include <utility>

#include "bsdf/bent_normal.h"
#include "bsdf/lobe.h"
#include "math/require.h"

namespace limn {

NormalMap::NormalMap(std::shared_ptr<const Material> material, std::shared_ptr<const Texture> normals)
    : material_(std::move(material)), normals_(std::move(normals)) {
    require(material_ != nullptr, "NormalMap: material must not be null");
    require(normals_ != nullptr, "NormalMap: texture must not be null");
    RecordSink sink;
    const bsdf::Lobe* lobe = material_->lower(sink).lobe;
    has_tangent_facet_ = lobe && lobe->one_sided;
}

Surface NormalMap::bent(const Surface& s, const Vec3& out) const {
    Surface result = s;
    result.shading_normal = bsdf::bent_normal(s, out, normals_->value(s));
    if (has_tangent_facet_) result.normal = result.shading_normal;
    return result;
}

std::optional<ScatterSample> NormalMap::sample(const Surface& s, const Vec3& out, const Random3& random) const {
    std::optional<ScatterSample> sample = material_->sample(bent(s, out), out, random);
    if (!has_tangent_facet_ || !sample) return sample;
    if (bsdf::is_below(s.normal, sample->direction)) sample->direction = bsdf::mirrored_at(s.normal, sample->direction);
    if (sample->pdf == 0) return sample;
    const ScatterValue f = value(s, out, sample->direction);
    if (is_black(f.value) || !(f.pdf > 0)) return std::nullopt;
    return ScatterSample{.direction = sample->direction, .weight = f.value / f.pdf, .pdf = f.pdf};
}

ScatterValue NormalMap::value(const Surface& s, const Vec3& out, const Vec3& in) const {
    const Surface around = bent(s, out);
    if (!has_tangent_facet_) return material_->value(around, out, in);
    if (bsdf::is_below(s.normal, in)) return {};
    const ScatterValue direct = material_->value(around, out, in);
    const ScatterValue mirrored = material_->value(around, out, bsdf::mirrored_at(s.normal, in));
    return {.value = direct.value + mirrored.value, .pdf = direct.pdf + mirrored.pdf};
}

MaterialRecord NormalMap::lower(RecordSink& sink) const {
    MaterialRecord record = material_->lower(sink);
    require(record.normal_map == TextureId::none, "NormalMap: the material must not be a NormalMap");
    record.normal_map = lower_texture(sink, normals_);
    record.uses_tangents = true;
    return record;
}

}  // namespace limn
