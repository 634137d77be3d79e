// A file that is written anew for each input, and reading that may be refused.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace limn::fuzz {

// `name` in a folder of this process, which stays: libFuzzer ends without destructors.
inline std::string scratch_path(const std::string& name) {
    const auto folder = std::filesystem::temp_directory_path() / ("limn-fuzz-" + std::to_string(getpid()));
    std::filesystem::create_directory(folder);
    return (folder / name).string();
}

inline void write_file(const std::string& path, std::string_view bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

// read(), which may throw a Fault: one that the reader is to find.
template <class Fault, class Read>
void attempt(Read read) try {
    read();
} catch (const Fault&) {}

}  // namespace limn::fuzz
