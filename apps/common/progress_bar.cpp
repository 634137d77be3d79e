#include "progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace limn::app {

namespace {

constexpr double kSecondsBetween = 0.2;  // the shortest time between two updates, which makes their cost negligible
constexpr int kCells = 30;               // the width of the bar in characters

// Returns a time in the unit that suits it.
std::string duration(double seconds) {
    if (seconds < 60) return fmt::format("{:.0f} s", seconds);
    if (seconds < 3600) return fmt::format("{:.0f} min", seconds / 60);
    return fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace

void ProgressBar::update(const Progress& progress) {
    if (!enabled_ || (drawn_ && progress.seconds - drawn_at_ < kSecondsBetween)) return;
    const double fraction = std::clamp(progress.fraction, 0.0, 1.0);
    const int full = static_cast<int>(kCells * fraction);
    std::string left;
    if (fraction > 0) left = fmt::format(", {} left", duration(progress.seconds * (1 - fraction) / fraction));
    const std::string line = fmt::format("\r[{:=<{}}{: <{}}] {:3.0f} %  {}{}\033[K", "", full, "", kCells - full,
                                         100 * fraction, duration(progress.seconds), left);
    // Ignore errors: the render continues even if the terminal is closed.
    std::fputs(line.c_str(), stderr);
    std::fflush(stderr);
    drawn_ = true;
    drawn_at_ = progress.seconds;
}

void ProgressBar::clear() {
    if (!drawn_) return;
    std::fputs("\r\033[K", stderr);
    drawn_ = false;
}

bool stderr_is_terminal() { return ::isatty(STDERR_FILENO) != 0; }

}  // namespace limn::app
