#include "interrupt.h"

#include <csignal>

namespace limn::app {

namespace {

volatile std::sig_atomic_t caught = 0;

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
