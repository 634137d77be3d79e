// The subcommands of limn. argv[0] is the name of the subcommand. Each function returns the exit status. run_program
// (program.h) turns an exception into an exit status.
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
