/// \file
/// Textures made of Perlin noise at `scale` times the world position. A lattice of one's own, or one from a seed: the
/// same seed gives the same lattice everywhere. All throw ArgumentError if scale is not finite, the lattice is null, or
/// a component of the colour is negative or not finite.
#pragma once

#include <cstdint>

#include "limn/core/perlin_lattice.h"
#include "limn/texture/texture.h"

namespace limn {

/// color * (1 + noise) / 2, noise in [-1, 1].
class Noise final : public Texture {
public:
    Noise(double scale, std::uint64_t seed, const Color& color = {1, 1, 1});
    Noise(double scale, std::shared_ptr<const PerlinLattice> lattice, const Color& color = {1, 1, 1});
    Color value(const Surface& s) const override;
    TextureRecord lower(RecordSink& sink) const override;

private:
    double scale_;
    std::shared_ptr<const PerlinLattice> lattice_;
    Color color_;
};

/// color * turbulence: the absolute value of seven octaves' sum, weights 1, 1/2, 1/4, ...
class Turbulence final : public Texture {
public:
    Turbulence(double scale, std::uint64_t seed, const Color& color = {1, 1, 1});
    Turbulence(double scale, std::shared_ptr<const PerlinLattice> lattice, const Color& color = {1, 1, 1});
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
    Marble(double scale, std::uint64_t seed, const Color& color = {1, 1, 1});
    Marble(double scale, std::shared_ptr<const PerlinLattice> lattice, const Color& color = {1, 1, 1});
    Color value(const Surface& s) const override;
    TextureRecord lower(RecordSink& sink) const override;

private:
    double scale_;
    std::shared_ptr<const PerlinLattice> lattice_;
    Color color_;
};

}  // namespace limn
