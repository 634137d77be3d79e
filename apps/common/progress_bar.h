/// \file
/// The progress bar of renders and other long commands.
#pragma once

#include "limn/render/settings.h"

namespace limn::app {

/// A line on stderr that shows the progress and the remaining time. Not thread-safe. The destructor removes the line.
class ProgressBar {
public:
    /// \param enabled if false, nothing is ever drawn
    explicit ProgressBar(bool enabled) : enabled_(enabled) {}
    ~ProgressBar() { clear(); }
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// Draws the line, at most five times per second.
    void update(const Progress& progress);
    /// Removes the line.
    void clear();

private:
    bool enabled_;
    bool drawn_ = false;
    double drawn_at_ = 0;  // in seconds, as Progress::seconds
};

/// True if stderr is a terminal.
bool stderr_is_terminal();

}  // namespace limn::app
