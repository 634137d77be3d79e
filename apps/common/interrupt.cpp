#include "interrupt.h"

#include <atomic>
#include <csignal>

namespace limn::app {

namespace {

std::atomic<int> caught = 0;  // read by the threads of a render
static_assert(std::atomic<int>::is_always_lock_free);

extern "C" void remember_signal(int signal) {
    caught = signal;
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
    struct sigaction action = {};
    action.sa_handler = remember_signal;
    action.sa_flags = SA_RESTART;  // reading a model goes on undisturbed
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

int caught_signal() { return caught; }

}  // namespace limn::app
