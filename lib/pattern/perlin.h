// Gradient noise and what is made of it. All are pure, finite for any coordinates, and defined on the whole of space:
// the lattice repeats every 256 cells.
#pragma once

#include "limn/core/perlin_lattice.h"
#include "limn/core/vec.h"

namespace limn::pattern {

/// Perlin, An Image Synthesizer, SIGGRAPH 1985: in [-1, 1], zero at lattice points and where p is not finite.
double noise(const PerlinLattice& lattice, const Point3& p);

/// The absolute value of seven octaves' sum: frequencies 1, 2, 4, ..., weights 1, 1/2, 1/4, ... In [0, 2).
double turbulence(const PerlinLattice& lattice, const Point3& p);

// What the textures multiply their colour by.

/// (1 + noise(scale p)) / 2, in [0, 1].
double noise_factor(const PerlinLattice& lattice, double scale, const Point3& p);

/// turbulence(scale p).
double turbulence_factor(const PerlinLattice& lattice, double scale, const Point3& p);

/// Stripes along z bent by turbulence, (1 + sin(scale z + 10 turbulence(scale p))) / 2. In [0, 1].
double marble(const PerlinLattice& lattice, double scale, const Point3& p);

}  // namespace limn::pattern
