#include "interrupt.h"

#include <atomic>
#include <csignal>

namespace limn::app {

namespace {

std::atomic<int> caught = 0;  // atomic, because the threads of a render read it
static_assert(std::atomic<int>::is_always_lock_free);

// Stores the signal, and restores the default handlers, so that the next signal ends the program.
extern "C" void remember_signal(int signal) {
    caught = signal;
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
    struct sigaction action = {};
    action.sa_handler = remember_signal;
    action.sa_flags = SA_RESTART;  // a signal does not make reading a model fail
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

int caught_signal() { return caught; }

}  // namespace limn::app
