// The files of the repository as the architecture tests see them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace limn::architecture {

struct Include {
    std::string path;    // what stands between the quotes or brackets
    bool angle = false;  // <...>
    int line = 0;
};

struct SourceFile {
    std::string path;  // from the repository's root, with slashes
    std::string code;  // without comments and without what stands in literals; empty unless it is C++
    std::vector<Include> includes;
    int lines = 0;

    SourceFile(std::string path_, std::string_view text);
};

using SourceTree = std::vector<SourceFile>;

/// The C++ and CMake files under the given folders of `root`, sorted by path.
SourceTree read_tree(const std::string& root, const std::vector<std::string>& folders);

bool is_header(const SourceFile& file);

/// The room that a file belongs to: "shape" for include/limn/shape/x.h and lib/shape/x.cpp. records.h and record_sink.h
/// are rooms of one header, with their sources in lib/records. Empty for the umbrella and for files outside both
/// folders.
std::string room_of(std::string_view path);

}  // namespace limn::architecture
