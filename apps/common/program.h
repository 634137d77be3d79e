/// \file
/// The messages and exit status of every program.
#pragma once

#include <functional>
#include <string>

#include "limn/math/error.h"

namespace limn::app {

// The exit status of a program. A program that SIGINT or SIGTERM has stopped returns 128 plus the signal's number. If
// an output could not be saved, it returns kFailed instead.
inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;        ///< an error in files, memory or the environment
inline constexpr int kBadArguments = 2;  ///< an error in the arguments themselves
inline constexpr int kUnfinished = 3;    ///< limn merge: the error is not reached, and --plan was written

/// Writes messages to stderr, with the name of the program before each.
struct Console {
    std::string program;
    bool quiet = false;  ///< true: only errors are written

    void note(const std::string& message) const;
    void error(const std::string& message) const;
};

/// Runs a step whose arguments come from files, and returns its result. An ArgumentError of the step is rethrown as an
/// Error, because the files are wrong and not the command line.
template <class Step>
auto from_files(const Step& step) {
    try {
        return step();
    } catch (const ArgumentError& e) {
        throw Error(e.what());
    }
}

/// Runs `body` and returns its exit status. If it throws, prints the message on stderr and returns kBadArguments for an
/// ArgumentError, kFailed for everything else. Sets SIGPIPE to be ignored.
int run_program(const std::string& program, const std::function<int()>& body) noexcept;

}  // namespace limn::app
