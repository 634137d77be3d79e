/// \file
/// Handling of SIGINT and SIGTERM. The first signal stops the render and saves it. A second one ends the program.
#pragma once

namespace limn::app {

/// Installs the handlers, even if the parent process set the signals to be ignored.
void catch_interrupts();

/// Returns the signal that was caught, or 0. Thread-safe.
int caught_signal();

}  // namespace limn::app
