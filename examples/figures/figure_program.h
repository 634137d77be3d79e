// What the figures' programs call; no more, as there are many of them to compile.
#pragma once

#include <string_view>

namespace limn::figures {

/// The whole of a figure's program, as figure_main says. `name` is one of figures.h.
int figure_program(std::string_view name, int argc, char** argv);

}  // namespace limn::figures
