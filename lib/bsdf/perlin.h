// Gradient noise, and turbulence and marble, which are computed from it. The functions are pure. Their result is finite
// for any coordinates. The lattice repeats every 256 cells.
#pragma once

#include "limn/math/perlin_lattice.h"
#include "limn/math/vec.h"

namespace limn::pattern {

/// Returns gradient noise in [-1, 1]: Perlin, An Image Synthesizer, SIGGRAPH 1985. It is 0 at lattice points, and if p
/// isn't finite.
double noise(const PerlinLattice& lattice, const Point3& p);

/// Returns the absolute value of the sum of seven octaves of noise, in [0, 2). The frequencies are 1, 2, 4, ... and the
/// weights 1, 1/2, 1/4, ...
double turbulence(const PerlinLattice& lattice, const Point3& p);

// The textures multiply their colour by the factors below.

/// Returns (1 + noise(scale p)) / 2, in [0, 1].
double noise_factor(const PerlinLattice& lattice, double scale, const Point3& p);

/// Returns turbulence(scale p).
double turbulence_factor(const PerlinLattice& lattice, double scale, const Point3& p);

/// Returns (1 + sin(scale z + 10 turbulence(scale p))) / 2, in [0, 1]: stripes across z, distorted by turbulence. It is
/// 0.5 if the sine's argument isn't finite.
double marble(const PerlinLattice& lattice, double scale, const Point3& p);

}  // namespace limn::pattern
