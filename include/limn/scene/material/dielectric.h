/// \file
/// A material for clear glass and water.
#pragma once

#include "limn/scene/material/material.h"

namespace limn {

/// A smooth interface between two clear media. `sample` reflects with the probability of the reflectance and refracts
/// otherwise. The weight is 1. Radiance is not scaled by 1/n^2 when it enters a medium of index n. The factor cancels
/// as long as the camera and the lights are outside. A direction that an interpolated shading normal sends to the wrong
/// side of the geometric surface is absorbed.
class Dielectric final : public Material {
public:
    /// \param index index of refraction inside over that outside, where outside is the side of the shape's outward
    /// normal; below 1 for a bubble
    /// \param fresnel the formula of the reflectance
    ///
    /// \throws ArgumentError if the index is not positive and finite
    explicit Dielectric(double index, Fresnel fresnel = Fresnel::exact);
    std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& random) const override;
    MaterialRecord lower(RecordSink& sink) const override;

private:
    double index_;
    Fresnel fresnel_;
};

}  // namespace limn
