// How much memory a call takes at its peak.
#pragma once

#include <fstream>
#include <string>

#include "catch.h"

namespace limn::test {

// The most memory that the process has had since its record was cleared, in KiB (proc(5), VmHWM).
inline long peak_kib() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("VmHWM:")) return std::stol(line.substr(6));
    FAIL("/proc/self/status has no VmHWM");
    return 0;
}

// Checks that `call` takes less than `most_kib` more than there was before it, whatever ran earlier.
template <class Call>
void check_memory(long most_kib, Call call) {
    std::ofstream record("/proc/self/clear_refs");
    if (!(record << 5 << std::flush)) {
        WARN("/proc/self/clear_refs cannot be written, so that memory is not checked");
        return call();
    }
    const long before = peak_kib();
    call();
    CHECK(peak_kib() - before < most_kib);
}

}  // namespace limn::test
