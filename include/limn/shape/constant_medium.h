/// \file
/// Fog, smoke, milk.
#pragma once

#include "limn/shape/hittable.h"
#include "limn/texture/texture.h"

namespace limn {

/// A homogeneous medium inside a closed boundary, which may have holes and hollows; the eye and lights may be inside,
/// and media may overlap. Extinction is `density` per world unit of length, the single-scattering albedo is the colour,
/// the phase function is isotropic. The boundary itself does not bend or reflect light, whatever its material: `hit`
/// reports its crossing as `index_matched`; the path loop draws the free flight.
class ConstantMedium final : public Hittable {
public:
    /// \param boundary must not contain a medium itself: compile() refuses it. An odd number of crossings ahead is
    /// inside, so nested closed surfaces make shells, and a surface that is there twice bounds nothing.
    /// \param density extinction per world unit of length: light goes 1 / density far in the mean
    /// \param albedo the share of it that scatters, in [0, 1]; a texture is evaluated by position alone
    ///
    /// \throws ArgumentError if the boundary or texture is null, the density is negative or not finite, the albedo
    /// outside [0, 1]
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
