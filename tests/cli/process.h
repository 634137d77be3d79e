// Runs programs as a shell would.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace limn::test {

struct Outcome {
    int status = -1;  ///< exit status; minus the signal's number if one ended the program
    std::string out, err;
};

using Words = std::vector<std::string>;

/// Runs a program to its end, with stdout and stderr not going to a terminal.
Outcome run(const std::string& program, const Words& arguments, const std::string& folder = ".");
/// The same for bin/limn.
Outcome limn(const Words& arguments);

/// A program that runs with a terminal as its stderr.
class OnTerminal {
public:
    OnTerminal(const std::string& program, const Words& arguments);
    ~OnTerminal();
    OnTerminal(const OnTerminal&) = delete;
    OnTerminal& operator=(const OnTerminal&) = delete;

    /// Reads the terminal until `text` has appeared once more; false if the program ended before.
    bool wait_for(const std::string& text);
    void send(int signal) const;
    /// Waits for the end.
    Outcome finish();

private:
    bool read_some();

    pid_t process_ = -1;
    int terminal_ = -1;
    std::string seen_;
    std::size_t waited_to_ = 0;  // in seen_
};

}  // namespace limn::test
