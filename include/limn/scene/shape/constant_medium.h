/// \file
/// A homogeneous medium: fog, smoke, milk.
#pragma once

#include "limn/scene/shape/hittable.h"
#include "limn/scene/texture/texture.h"

namespace limn {

/// A homogeneous medium inside a closed boundary, with an isotropic phase function.
///
/// - A point is inside if a ray from it crosses the boundary an odd number of times. Nested closed surfaces therefore
///   make shells. Two coincident surfaces bound nothing.
/// - The boundary neither refracts nor reflects light. Its material is ignored and may be null. `hit` returns a hit of
///   the boundary and sets Hit::index_matched. The renderer samples the free flight inside.
/// - The camera and lights may be inside. Media may overlap.
/// - compile() throws ArgumentError if the boundary contains a medium.
class ConstantMedium final : public Hittable {
public:
    /// \param boundary a closed surface
    /// \param density extinction coefficient per world unit of length, at least 0: the mean free path is 1 / density
    /// \param albedo single-scattering albedo, in [0, 1], or a texture, which gets the position alone
    ///
    /// \throws ArgumentError if the boundary or the texture is null, the density is negative or not finite, or the
    /// albedo is outside [0, 1]
    ///@{
    ConstantMedium(std::shared_ptr<const Hittable> boundary, double density, const Color& albedo);
    ConstantMedium(std::shared_ptr<const Hittable> boundary, double density, std::shared_ptr<const Texture> albedo);
    ///@}
    Box bounds() const override { return boundary_->bounds(); }
    std::optional<Hit> hit(const Ray& ray) const override;
    void lower(RecordSink& sink) const override;

private:
    std::shared_ptr<const Hittable> boundary_;
    double density_;
    std::shared_ptr<const Material> phase_;
};

}  // namespace limn
