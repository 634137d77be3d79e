/// \file
/// Ground glass, frosted glass, ice.
#pragma once

#include "limn/material/material.h"
#include "limn/material/roughness.h"

namespace limn {

/// An interface to a clear medium whose microfacets reflect and refract as a Dielectric does (Walter, Marschner, Li and
/// Torrance, Microfacet Models for Refraction through Rough Surfaces, EGSR 2007), with the distribution of Trowbridge
/// and Reitz (GGX) and the masking of Smith. Of roughness 0 it is a Dielectric, bit for bit. As there, radiance is not
/// scaled by 1/n^2, so that what goes through is reciprocal but for the squares of the indices. Light that facets
/// scatter more than once is lost: at an index of 1.5 and normal incidence 0.1 % at a roughness of 0.3, 0.8 % at 0.5
/// and 11 % at 1, and there 58 % from inside.
class RoughDielectric final : public Material {
public:
    /// \param index inside over outside; below 1 for a bubble
    /// \param roughness see Roughness
    ///
    /// \throws ArgumentError if the index is not positive and finite, or the roughness is not in [0, 1]
    RoughDielectric(double index, const Roughness& roughness);
    std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& random) const override;
    ScatterValue value(const Surface& s, const Vec3& out, const Vec3& in) const override;
    MaterialRecord lower(RecordSink& sink) const override;

private:
    double index_;
    std::shared_ptr<const MaterialDetails> details_;  // null: smooth
};

}  // namespace limn
