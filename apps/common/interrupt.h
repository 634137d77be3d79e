/// \file
/// SIGINT and SIGTERM: the first stops the render and saves, a second one ends the program at once.
#pragma once

namespace limn::app {

/// Installs the handlers, also where a parent process had the signals ignored.
void catch_interrupts();

/// The signal that came, or 0.
int caught_signal();

}  // namespace limn::app
