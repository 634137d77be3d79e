// Runs programs as a shell would, and limn's commands without one.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "support/folder.h"

namespace limn::test {

struct Outcome {
    int status = -1;  ///< exit status; minus the signal's number if one ended the program
    std::string out, err;
};

using Words = std::vector<std::string>;

/// Runs a program to its end, with empty stdin, and stdout and stderr not going to a terminal.
Outcome run(const std::string& program, const Words& arguments, const std::string& folder = ".");
/// Does what bin/limn does, in this process: to load OpenImageIO takes each new one a quarter of a second. For `limn
/// trace` use limn_reads(), as it looks what stdout is.
Outcome limn(const Words& arguments, const std::string& folder = ".");
/// Runs bin/limn with `input` as its stdin.
Outcome limn_reads(const std::string& input, const Words& arguments);
/// The same, with stdout going to the file `path`, which must be there.
Outcome limn_writes(const std::string& path, const Words& arguments);

/// bin/limn at the other end of two pipes.
class Conversation {
public:
    explicit Conversation(const Words& arguments);
    ~Conversation();
    Conversation(const Conversation&) = delete;
    Conversation& operator=(const Conversation&) = delete;

    void say(const std::string& text);
    /// The next `size` bytes that it says; fewer if it ends, or says no more for a minute.
    std::string hear(std::size_t size);
    /// Closes the pipe that it writes to.
    void stop_listening();
    /// Closes the pipe that it reads, and waits for the end.
    Outcome finish();

private:
    Folder folder_;
    pid_t process_ = -1;
    int to_ = -1, from_ = -1;
};

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
