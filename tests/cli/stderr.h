#pragma once

#include <unistd.h>

#include <cstdio>
#include <stdexcept>
#include <string>

#include "support/folder.h"

namespace limn::test {

/// What `speak` writes to stderr.
template <class Speak>
std::string written_to_stderr(const Speak& speak) {
    const Folder folder;
    std::fflush(stderr);
    const int before = dup(STDERR_FILENO);
    std::FILE* const file = std::fopen(folder.path("stderr").c_str(), "w");
    if (before < 0 || !file || dup2(fileno(file), STDERR_FILENO) < 0) throw std::runtime_error("no stderr");
    speak();
    std::fflush(stderr);
    dup2(before, STDERR_FILENO);
    close(before);
    std::fclose(file);
    return folder.read("stderr");
}

}  // namespace limn::test
