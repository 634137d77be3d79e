/// \file
/// A material for clear glass and water.
#pragma once

#include <cstdint>

#include "limn/scene/material/material.h"

namespace limn {

/// A formula for the reflectance of a dielectric.
///
/// - `exact`: Fresnel's equations for unpolarised light (Born and Wolf, Principles of Optics, 7th ed., section 1.5.2).
/// - `schlick`: Schlick's approximation (An Inexpensive BRDF Model for Physically-based Rendering, 1994). It takes the
///   cosine of the incident direction on both sides of the surface, as in Shirley, Ray Tracing in One Weekend.
enum class Fresnel : std::uint8_t { exact, schlick };

/// A smooth interface between two clear media. `sample` reflects with the probability of the reflectance and refracts
/// otherwise. The weight is 1. Radiance is not scaled by 1/n^2 when it enters a medium of index n. The factor cancels
/// if the camera and the lights are outside. A direction that an interpolated shading normal sends to the wrong
/// side of the geometric surface is absorbed.
class Dielectric final : public Material {
public:
    /// The parameters of the lobe. N is double, or a vector of doubles.
    template <class N>
    struct Parameters {
        N index;          ///< index of refraction inside over that outside
        N exact_fresnel;  ///< 1 for Fresnel::exact, 0 for Fresnel::schlick
    };

    /// \param index index of refraction inside over that outside, where outside is the side of the shape's outward
    /// normal; below 1 for a bubble
    /// \param fresnel the formula of the reflectance
    ///
    /// \throws ArgumentError if the index is not positive and finite
    explicit Dielectric(double index, Fresnel fresnel = Fresnel::exact);
    std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& random) const override;
    MaterialRecord lower(RecordSink& sink) const override;

private:
    Parameters<double> parameters_;
};

}  // namespace limn
