/// \file
/// Mirrors and brushed metal.
#pragma once

#include "limn/material/material.h"

namespace limn {

/// A mirror of the given albedo (no Fresnel term) whose reflected unit direction is displaced by fuzz times a point
/// drawn uniformly in the unit ball (Shirley, Ray Tracing in One Weekend, section 9.6); what ends below the surface is
/// absorbed. fuzz 0 is a perfect mirror. So rough metal loses light where it is seen at a cosine c below its fuzz f:
/// the share (f - c)^2 (2 f + c) / (4 f^3), one half at grazing incidence.
class Metal final : public Material {
public:
    /// \throws ArgumentError if the albedo is outside [0, 1] or fuzz is outside [0, 1]; if the texture is null
    ///@{
    explicit Metal(const Color& albedo, double fuzz = 0);
    explicit Metal(std::shared_ptr<const Texture> albedo, double fuzz = 0);
    ///@}
    std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& random) const override;
    ScatterValue value(const Surface& s, const Vec3& out, const Vec3& in) const override;
    MaterialRecord lower(RecordSink& sink) const override;

private:
    std::shared_ptr<const Texture> albedo_;
    double fuzz_;
};

}  // namespace limn
