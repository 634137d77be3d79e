/// \file
/// Glass, water.
#pragma once

#include "limn/material/material.h"

namespace limn {

/// A smooth interface to a clear medium of the given index of refraction, relative to what is outside the shape's
/// outward normal. Reflects or refracts with the probability of its reflectance, weight 1. Radiance is not scaled by
/// 1/n^2, which cancels as long as camera and lights are outside.
class Dielectric final : public Material {
public:
    /// \param index inside over outside; below 1 for a bubble
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
