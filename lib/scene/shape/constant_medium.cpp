#include "limn/scene/shape/constant_medium.h"

#include <cmath>

#include "limn/scene/material/isotropic.h"
#include "limn/scene/texture/solid.h"
#include "scene/shape/arguments.h"

namespace limn {

ConstantMedium::ConstantMedium(std::shared_ptr<const Hittable> boundary, double density, const Color& albedo)
    : boundary_(std::move(boundary)), density_(density), phase_(std::make_shared<Isotropic>(albedo)) {
    require_not_null(boundary_, "ConstantMedium", "the boundary");
    if (!std::isfinite(density) || density < 0)
        throw ArgumentError("ConstantMedium: the density must be finite and not negative");
}

ConstantMedium::ConstantMedium(std::shared_ptr<const Hittable> boundary, double density,
                               std::shared_ptr<const Texture> albedo)
    : ConstantMedium(std::move(boundary), density, Color{}) {
    phase_ = std::make_shared<Isotropic>(std::move(albedo));
}

std::optional<Hit> ConstantMedium::hit(const Ray& ray) const {
    std::optional<Hit> hit = boundary_->hit(ray);
    if (!hit) return std::nullopt;
    hit->material = phase_.get();
    hit->index_matched = true;
    return hit;
}

void ConstantMedium::lower(RecordSink& sink) const {
    const BlasId boundary = sink.blas(boundary_, [&](RecordSink& inner) { boundary_->lower(inner); });
    sink.medium({boundary, lower_material(sink, phase_), density_});
}

}  // namespace limn
