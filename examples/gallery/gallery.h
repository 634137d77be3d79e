/// \file
/// The pictures of docs/gallery.md that are programs. To add one, write NAME.cpp with a function of that name, and add
/// the function here and the name to CMakeLists.txt.
#pragma once

#include "figure.h"

namespace limn::gallery {

/// A knot of brushed copper on a stone slab, under a clear sky with its sun. Reads examples/models/knot.ply.
Figure copper_knot();
/// A glass of water with a straw, by a white window.
Figure glass_of_water();
/// Four hundred knots of plastic and gold, with a wide aperture. Reads examples/models/knot.ply.
Figure field_of_knots();
/// A room into which sun and sky shine through a window. Reads examples/models/knot.ply.
Figure sunlit_room();

}  // namespace limn::gallery
