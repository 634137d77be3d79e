/// \file
/// The messages and exit status of every program.
#pragma once

#include <functional>
#include <string>

#include "limn/core/error.h"

namespace limn::app {

// Exit status.
inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;        ///< something is wrong in files, memory or environment
inline constexpr int kBadArguments = 2;  ///< something is wrong in the arguments alone
inline constexpr int kUnfinished = 3;    ///< limn merge: another round is to be rendered

/// Writes to stderr, each line with the name of the program before it.
struct Console {
    std::string program;
    bool quiet = false;  ///< errors only

    void note(const std::string& message) const;
    void error(const std::string& message) const;
};

/// Runs a step whose arguments come out of files: what a library function refuses there is a fault of those files, not
/// of the command line.
template <class Step>
auto from_files(const Step& step) {
    try {
        return step();
    } catch (const ArgumentError& e) {
        throw Error(e.what());
    }
}

/// Runs `body` and turns what it throws into a message on stderr and an exit status.
int run_program(const std::string& program, const std::function<int()>& body) noexcept;

}  // namespace limn::app
