/// \file
/// Clocks. What one thread does is measured by the processor's time that it takes, so that other programs count less;
/// what several do by the time that passes.
#pragma once

#include <time.h>

namespace limn::bench {

enum class Clock { wall = CLOCK_MONOTONIC, process = CLOCK_PROCESS_CPUTIME_ID, thread = CLOCK_THREAD_CPUTIME_ID };

class Stopwatch {
public:
    explicit Stopwatch(Clock clock) : clock_(clock), begin_(now()) {}
    double seconds() const { return now() - begin_; }

private:
    double now() const {
        timespec time{};
        clock_gettime(static_cast<clockid_t>(clock_), &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }

    Clock clock_;
    double begin_;
};

}  // namespace limn::bench
