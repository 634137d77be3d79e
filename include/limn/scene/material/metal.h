/// \file
/// A material for mirrors and simple rough metal.
#pragma once

#include "limn/scene/material/material.h"

namespace limn {

/// A mirror without a Fresnel term, whose reflected unit direction is displaced by `fuzz` times a point drawn uniformly
/// in the unit ball (Shirley, Ray Tracing in One Weekend, section 9.6). A displaced direction that points below the
/// surface is absorbed. Let c be the cosine of the viewing angle and f the fuzz. The share of the light that is lost
/// that way is (f - c)^2 (2 f + c) / (4 f^3) if c < f, and 0 otherwise. It is one half at grazing incidence.
class Metal final : public Material {
public:
    /// The parameters of the lobe. N is double, or a vector of doubles.
    template <class N>
    struct Parameters {
        N fuzz;  ///< radius of the ball
    };

    /// \param albedo share of the light that is reflected, in [0, 1], or a texture
    /// \param fuzz radius of the ball, in [0, 1]; 0 is a perfect mirror
    ///
    /// \throws ArgumentError if the albedo or the fuzz is outside [0, 1], or the texture is null
    ///@{
    explicit Metal(const Color& albedo, double fuzz = 0);
    explicit Metal(std::shared_ptr<const Texture> albedo, double fuzz = 0);
    ///@}
    std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& random) const override;
    ScatterValue value(const Surface& s, const Vec3& out, const Vec3& in) const override;
    MaterialRecord lower(RecordSink& sink) const override;

private:
    std::shared_ptr<const Texture> albedo_;
    Parameters<double> parameters_;
};

}  // namespace limn
