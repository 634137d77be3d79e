#include "process.h"
#include "support/folder.h"

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>

namespace limn::test {

namespace {

struct Streams {
    int out, err;
};

pid_t start(const std::string& program, const Words& arguments, const std::string& folder, Streams streams) {
    std::vector<char*> argv = {const_cast<char*>(program.c_str())};
    for (const std::string& word : arguments) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("cannot fork");
    if (child > 0) return child;
    if (chdir(folder.c_str()) == 0 && dup2(streams.out, 1) == 1 && dup2(streams.err, 2) == 2)
        execv(program.c_str(), argv.data());
    _exit(127);
}

int wait_for_end(pid_t process) {
    int status = 0;
    if (waitpid(process, &status, 0) != process) throw std::runtime_error("cannot wait");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

int create(const std::string& path) { return open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600); }

}  // namespace

Outcome run(const std::string& program, const Words& arguments, const std::string& folder) {
    const Folder streams;
    const int out = create(streams.path("out")), err = create(streams.path("err"));
    Outcome outcome;
    outcome.status = wait_for_end(start(program, arguments, folder, {out, err}));
    close(out);
    close(err);
    outcome.out = streams.read("out");
    outcome.err = streams.read("err");
    return outcome;
}

Outcome limn(const Words& arguments) { return run(LIMN_PROGRAM, arguments); }

OnTerminal::OnTerminal(const std::string& program, const Words& arguments) {
    terminal_ = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (terminal_ < 0 || grantpt(terminal_) != 0 || unlockpt(terminal_) != 0)
        throw std::runtime_error("no pseudo terminal");
    const int slave = open(ptsname(terminal_), O_RDWR | O_NOCTTY | O_CLOEXEC);
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    process_ = start(program, arguments, ".", {nowhere, slave});
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
