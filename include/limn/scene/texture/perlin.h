/// \file
/// Textures of Perlin noise (Perlin, An Image Synthesizer, SIGGRAPH 1985), as in Shirley, Ray Tracing: The Next Week,
/// chapter 5. The noise is evaluated at `scale` times the world position p, where `scale` is the number of cells per
/// world unit. It repeats after 256 cells. All textures are finite at every position.
#pragma once

#include <cstdint>

#include "limn/math/perlin_lattice.h"
#include "limn/scene/texture/texture.h"

namespace limn {

/// The texture color * (1 + noise(scale p)) / 2, with noise in [-1, 1].
class Noise final : public Texture {
public:
    /// The lattice is given, or made from a seed. A seed gives the same lattice on every platform.
    ///
    /// \param scale cells per world unit
    /// \param color factor of the noise, at least 0
    ///
    /// \throws ArgumentError if the scale is not finite, the lattice is null, or a component of the colour is negative
    /// or not finite
    ///@{
    Noise(double scale, std::uint64_t seed, const Color& color = {1, 1, 1});
    Noise(double scale, std::shared_ptr<const PerlinLattice> lattice, const Color& color = {1, 1, 1});
    ///@}
    Color value(const Surface& s) const override;
    TextureRecord lower(RecordSink& sink) const override;

private:
    double scale_;
    std::shared_ptr<const PerlinLattice> lattice_;
    Color color_;
};

/// The texture color * turbulence(scale p). Turbulence is the absolute value of a sum of seven octaves of noise, which
/// have the frequencies 1, 2, 4, ... and the weights 1, 1/2, 1/4, ... It is in [0, 2).
class Turbulence final : public Texture {
public:
    /// The lattice is given, or made from a seed. A seed gives the same lattice on every platform.
    ///
    /// \param scale cells per world unit
    /// \param color factor of the noise, at least 0
    ///
    /// \throws ArgumentError if the scale is not finite, the lattice is null, or a component of the colour is negative
    /// or not finite
    ///@{
    Turbulence(double scale, std::uint64_t seed, const Color& color = {1, 1, 1});
    Turbulence(double scale, std::shared_ptr<const PerlinLattice> lattice, const Color& color = {1, 1, 1});
    ///@}
    Color value(const Surface& s) const override;
    TextureRecord lower(RecordSink& sink) const override;

private:
    double scale_;
    std::shared_ptr<const PerlinLattice> lattice_;
    Color color_;
};

/// The texture color * (1 + sin(scale z + 10 turbulence(scale p))) / 2: stripes along z that turbulence distorts.
class Marble final : public Texture {
public:
    /// The lattice is given, or made from a seed. A seed gives the same lattice on every platform.
    ///
    /// \param scale cells per world unit
    /// \param color factor of the noise, at least 0
    ///
    /// \throws ArgumentError if the scale is not finite, the lattice is null, or a component of the colour is negative
    /// or not finite
    ///@{
    Marble(double scale, std::uint64_t seed, const Color& color = {1, 1, 1});
    Marble(double scale, std::shared_ptr<const PerlinLattice> lattice, const Color& color = {1, 1, 1});
    ///@}
    Color value(const Surface& s) const override;
    TextureRecord lower(RecordSink& sink) const override;

private:
    double scale_;
    std::shared_ptr<const PerlinLattice> lattice_;
    Color color_;
};

}  // namespace limn
