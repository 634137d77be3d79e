/// \file
#pragma once

#include "limn/render/settings.h"

namespace limn::app {

/// A line on stderr that shows how far a render is. Not thread-safe.
class ProgressBar {
public:
    /// \param enabled if false, nothing is ever drawn
    explicit ProgressBar(bool enabled) : enabled_(enabled) {}
    ~ProgressBar() { clear(); }
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    void update(const Progress& progress);
    /// Takes the line away.
    void clear();

private:
    bool enabled_;
    bool drawn_ = false;
    double drawn_at_ = 0;
};

/// Whether stderr is a terminal.
bool stderr_is_terminal();

}  // namespace limn::app
