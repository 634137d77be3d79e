#include "text_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <set>
#include <system_error>

#include "limn/core/error.h"

namespace limn::app {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path) { throw FileError(path, std::generic_category().message(errno)); }

// The file itself, behind any links.
fs::path resolved(const std::string& path) {
    std::error_code problem;
    const fs::path whole = fs::weakly_canonical(fs::absolute(path, problem), problem);
    return problem ? fs::path(path) : whole;
}

bool write_and_close(int file, std::string_view text) {
    bool good = true;
    while (good && !text.empty()) {
        const ssize_t written = ::write(file, text.data(), text.size());
        if (written >= 0) text.remove_prefix(static_cast<std::size_t>(written));
        good = written >= 0 || errno == EINTR;
    }
    good = good && ::fsync(file) == 0;
    const int problem = errno;
    const bool closed = ::close(file) == 0;
    if (!good) errno = problem;
    return good && closed;
}

}  // namespace

std::string table_row(std::string_view name, std::string_view value) { return fmt::format("{:<24}{}\n", name, value); }

void check_text_path(const std::string& path) {
    if (path == "-") return;
    if (path.empty()) throw FileError("''", "is not the name of a file");
    const fs::path file = resolved(path);
    std::error_code problem;
    const fs::file_status status = fs::status(file, problem);
    if (fs::exists(status) && !fs::is_regular_file(status)) throw FileError(path, "is not a regular file");
    if (fs::exists(status) && ::access(file.c_str(), W_OK) != 0) fail(path);
    if (!fs::is_directory(file.parent_path(), problem)) throw FileError(path, "its folder does not exist");
    if (::access(file.parent_path().c_str(), W_OK | X_OK) != 0) fail(path);
}

void write_text(const std::string& path, std::string_view text) {
    if (path == "-") {
        if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
            fail("standard output");
        return;
    }
    const fs::path target = resolved(path);
    const std::string temporary = target.string() + "." + std::to_string(::getpid()) + ".tmp";
    const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file < 0) fail(path);
    if (!write_and_close(file, text) || std::rename(temporary.c_str(), target.c_str()) != 0) {
        const int problem = errno;
        ::unlink(temporary.c_str());
        errno = problem;
        fail(path);
    }
}

void check_distinct(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs) {
    std::set<fs::path> taken;
    for (const std::string& path : inputs)
        if (!path.empty()) taken.insert(resolved(path));
    for (const std::string& path : outputs)
        if (!path.empty() && path != "-" && !taken.insert(resolved(path)).second)
            throw ArgumentError(path + ": is named twice, as two outputs or as input and output");
}

}  // namespace limn::app
