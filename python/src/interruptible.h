// A render that reports its progress to Python and that Ctrl-C ends.
#pragma once

#include <nanobind/nanobind.h>

#include "limn/render/render.h"

namespace limn::python {

// Renders in a new thread. The calling thread waits, calls `progress` unless it is None, and checks for signals. As
// `progress` runs in the calling thread, a notebook shows what it prints. A KeyboardInterrupt ends the render within a
// tile. Throws what the render, `progress` or a signal handler throws. \pre the GIL is held
RenderResult render_interruptibly(const CompiledScene& scene, const Camera& camera, RenderSettings settings,
                                  nanobind::handle progress);

}  // namespace limn::python
