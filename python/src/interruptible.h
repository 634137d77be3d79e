// A render that shows its progress, and ends at Ctrl-C.
#pragma once

#include <nanobind/nanobind.h>

#include "limn/render/render.h"

namespace limn::python {

// Renders in a thread of its own. The calling thread waits, calls `progress` (or None) there, and looks for signals: so
// a notebook shows what is printed, and a KeyboardInterrupt ends the render within a tile. \pre the interpreter's lock
// is held
RenderResult render_interruptibly(const CompiledScene& scene, const Camera& camera, RenderSettings settings,
                                  nanobind::handle progress);

}  // namespace limn::python
