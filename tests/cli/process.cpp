#include "process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>

namespace limn::test {

namespace {

struct Streams {
    int in, out, err;
};

pid_t start(const std::string& program, const Words& arguments, const std::string& folder, Streams streams) {
    std::vector<char*> argv = {const_cast<char*>(program.c_str())};
    for (const std::string& word : arguments) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("cannot fork");
    if (child > 0) return child;
    if (chdir(folder.c_str()) == 0 && dup2(streams.in, 0) == 0 && dup2(streams.out, 1) == 1 &&
        dup2(streams.err, 2) == 2)
        execv(program.c_str(), argv.data());
    _exit(127);
}

int wait_for_end(pid_t process) {
    int status = 0;
    if (waitpid(process, &status, 0) != process) throw std::runtime_error("cannot wait");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

int open_input(const std::string& path) { return open(path.c_str(), O_RDONLY | O_CLOEXEC); }
int create(const std::string& path) { return open(path.c_str(), O_WRONLY | O_CREAT | O_NOCTTY | O_CLOEXEC, 0600); }

Outcome run_between(const std::string& input, const std::string& output, const std::string& program,
                    const Words& arguments, const std::string& folder = ".") {
    const Folder streams;
    const int in = open_input(input), out = create(output.empty() ? streams.path("out") : output),
              err = create(streams.path("err"));
    Outcome outcome;
    outcome.status = wait_for_end(start(program, arguments, folder, {in, out, err}));
    for (const int stream : {in, out, err}) close(stream);
    outcome.out = streams.read("out");
    outcome.err = streams.read("err");
    return outcome;
}

}  // namespace

Outcome run(const std::string& program, const Words& arguments, const std::string& folder) {
    return run_between("/dev/null", "", program, arguments, folder);
}

Outcome limn_reads(const std::string& input, const Words& arguments) {
    const Folder folder;
    return run_between(folder.write("in", input), "", LIMN_PROGRAM, arguments);
}

Outcome limn_writes(const std::string& path, const Words& arguments) {
    return run_between("/dev/null", path, LIMN_PROGRAM, arguments);
}

Conversation::Conversation(const Words& arguments) {
    int input[2], output[2];
    if (pipe2(input, O_CLOEXEC) != 0 || pipe2(output, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    const int err = create(folder_.path("err"));
    process_ = start(LIMN_PROGRAM, arguments, ".", {input[0], output[1], err});
    for (const int end : {input[0], output[1], err}) close(end);
    to_ = input[1];
    from_ = output[0];
}

Conversation::~Conversation() {
    if (process_ > 0) {
        kill(process_, SIGKILL);
        waitpid(process_, nullptr, 0);
    }
    for (const int end : {to_, from_})
        if (end >= 0) close(end);
}

void Conversation::say(const std::string& text) {
    if (write(to_, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
        throw std::runtime_error("the program does not listen");
}

std::string Conversation::hear(std::size_t size) {
    constexpr int kMinute = 60'000;
    std::string heard;
    while (heard.size() < size) {
        pollfd ready{from_, POLLIN, 0};
        char buffer[512];
        if (poll(&ready, 1, kMinute) <= 0) break;
        const ssize_t count = read(from_, buffer, std::min(sizeof buffer, size - heard.size()));
        if (count <= 0) break;
        heard.append(buffer, static_cast<std::size_t>(count));
    }
    return heard;
}

void Conversation::stop_listening() {
    close(from_);
    from_ = -1;
}

Outcome Conversation::finish() {
    close(to_);
    to_ = -1;
    Outcome outcome;
    outcome.status = wait_for_end(process_);
    process_ = -1;
    outcome.err = folder_.read("err");
    return outcome;
}

OnTerminal::OnTerminal(const std::string& program, const Words& arguments) {
    terminal_ = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (terminal_ < 0 || grantpt(terminal_) != 0 || unlockpt(terminal_) != 0)
        throw std::runtime_error("no pseudo terminal");
    const int slave = open(ptsname(terminal_), O_RDWR | O_NOCTTY | O_CLOEXEC);
    const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
    process_ = start(program, arguments, ".", {nowhere, nowhere, slave});
    close(slave);
    close(nowhere);
}

OnTerminal::~OnTerminal() {
    if (process_ > 0) {
        kill(process_, SIGKILL);
        waitpid(process_, nullptr, 0);
    }
    close(terminal_);
}

bool OnTerminal::read_some() {
    char buffer[512];
    const ssize_t count = read(terminal_, buffer, sizeof buffer);
    if (count <= 0) return false;  // the program has closed its end
    seen_.append(buffer, static_cast<std::size_t>(count));
    return true;
}

bool OnTerminal::wait_for(const std::string& text) {
    for (;;) {
        const std::size_t found = seen_.find(text, waited_to_);
        if (found != std::string::npos) {
            waited_to_ = found + text.size();
            return true;
        }
        if (!read_some()) return false;
    }
}

void OnTerminal::send(int signal) const { kill(process_, signal); }

Outcome OnTerminal::finish() {
    while (read_some()) {}
    Outcome outcome;
    outcome.status = wait_for_end(process_);
    process_ = -1;
    outcome.err = seen_;
    return outcome;
}

}  // namespace limn::test
