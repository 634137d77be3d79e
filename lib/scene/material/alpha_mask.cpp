#include "limn/scene/material/alpha_mask.h"

#include <utility>

#include "limn/scene/texture/solid.h"
#include "math/require.h"
#include "scene/material/albedo.h"

namespace limn {

namespace {

std::shared_ptr<const Texture> constant(double opacity) {
    checked_share(opacity, "AlphaMask: opacity");
    return std::make_shared<SolidColor>(Color{opacity, opacity, opacity});
}

}  // namespace

AlphaMask::AlphaMask(std::shared_ptr<const Material> material, std::shared_ptr<const Texture> opacity, double cutoff)
    : material_(std::move(material)),
      opacity_(std::move(opacity)),
      cutoff_(checked_share(cutoff, "AlphaMask: cutoff")) {
    require(material_ != nullptr, "AlphaMask: material must not be null");
    require(opacity_ != nullptr, "AlphaMask: opacity texture must not be null");
}

AlphaMask::AlphaMask(std::shared_ptr<const Material> material, double opacity)
    : AlphaMask(std::move(material), constant(opacity)) {}

std::optional<ScatterSample> AlphaMask::sample(const Surface& s, const Vec3& out, const Random3& random) const {
    return material_->sample(s, out, random);
}

ScatterValue AlphaMask::value(const Surface& s, const Vec3& out, const Vec3& in) const {
    return material_->value(s, out, in);
}

MaterialRecord AlphaMask::lower(RecordSink& sink) const {
    MaterialRecord record = material_->lower(sink);
    require(record.opacity == TextureId::none, "AlphaMask: the material must not be an AlphaMask");
    record.opacity = lower_texture(sink, opacity_);
    record.opacity_cutoff = cutoff_;
    return record;
}

}  // namespace limn
