/// \file
/// Textures made of Perlin noise (Perlin, An Image Synthesizer, SIGGRAPH 1985) at `scale` times the world position, as
/// in Shirley, Ray Tracing: The Next Week, chapter 5. `scale` is in cells per world unit; the noise repeats after 256
/// cells. All are finite at every position.
#pragma once

#include <cstdint>

#include "limn/core/perlin_lattice.h"
#include "limn/texture/texture.h"

namespace limn {

/// color * (1 + noise) / 2, noise in [-1, 1].
class Noise final : public Texture {
public:
    /// With a lattice from a seed, the same everywhere, or one of the caller's.
    ///
    /// \throws ArgumentError if scale is not finite, the lattice is null, or a component of the colour is negative or
    /// not finite
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

/// color * turbulence: the absolute value of seven octaves' sum, frequencies 1, 2, 4, ..., weights 1, 1/2,
/// 1/4, ... In [0, 2).
class Turbulence final : public Texture {
public:
    /// With a lattice from a seed, the same everywhere, or one of the caller's.
    ///
    /// \throws ArgumentError if scale is not finite, the lattice is null, or a component of the colour is negative or
    /// not finite
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

/// color * (1 + sin(scale z + 10 turbulence(scale p))) / 2: stripes along z, bent by turbulence.
class Marble final : public Texture {
public:
    /// With a lattice from a seed, the same everywhere, or one of the caller's.
    ///
    /// \throws ArgumentError if scale is not finite, the lattice is null, or a component of the colour is negative or
    /// not finite
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
