// The main function of the figures' programs. This header includes little, because many programs include it.
#pragma once

#include <string_view>

namespace limn::figures {

/// Runs the program of the figure `name`, one of those in figures.h. Returns the exit status; see figure_main.
int figure_program(std::string_view name, int argc, char** argv);

}  // namespace limn::figures
