/// \file
/// Scenes of the convergence report with lights and materials beyond those of the figures.
#pragma once

#include <memory>

#include "figure.h"

namespace limn::bench {

/// A hilly ball of `material`, of the given radius around the centre.
std::shared_ptr<const Mesh> hilly_ball(const Point3& center, double radius, std::shared_ptr<const Material> material);

/// The hilly ball of rough copper on grey ground, under an environment map with a sun in it.
Figure rough_copper();
/// A ball of ground glass and a matte box in the Cornell box.
Figure rough_glass();
/// The still life of the gallery, a glTF model: normal maps, alpha and rough metal. Reads examples/models.
Figure still_life();

}  // namespace limn::bench
