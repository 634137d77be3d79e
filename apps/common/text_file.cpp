#include "text_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <set>
#include <system_error>

#include "limn/math/error.h"
#include "limn/math/system/files.h"

namespace limn::app {

std::string on_one_line(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = c == '\n' ? ' ' : '?';
    return text;
}

std::string table_row(std::string_view name, std::string_view value) {
    return fmt::format("{:<24}{}\n", name, on_one_line(std::string(value)));
}

void check_text_path(const std::string& path) {
    if (path != "-") check_text_writable(path);
}

void write_text(const std::string& path, std::string_view text) {
    if (path != "-") return save_text(text, path);
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
        throw FileError("standard output", std::generic_category().message(errno));
}

void check_distinct(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs) {
    std::set<std::string> read, written;
    for (const std::string& path : inputs)
        if (!path.empty()) read.insert(file_behind_links(path));
    for (const std::string& path : outputs) {
        if (path.empty() || path == "-") continue;
        const std::string file = file_behind_links(path);
        if (read.contains(file)) throw ArgumentError(path + ": would replace a file that is read");
        if (!written.insert(file).second) throw ArgumentError(path + ": is named twice as an output");
    }
}

}  // namespace limn::app
