// The subcommands. Each takes the arguments from its own name on, and returns the exit status; what it throws becomes
// one (see program.h).
#pragma once

namespace limn::app {

int render_command(int argc, const char* const* argv);
int compare_command(int argc, const char* const* argv);
int merge_command(int argc, const char* const* argv);
int info_command(int argc, const char* const* argv);
int trace_command(int argc, const char* const* argv);
int bench_command(int argc, const char* const* argv);

/// Runs the whole command line, argv[0] included, and returns the exit status.
int run_limn(int argc, const char* const* argv) noexcept;

}  // namespace limn::app
