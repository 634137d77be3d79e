#include "math/system/read_file.h"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <new>

#include "limn/math/error.h"
#include "math/system/replace_file.h"

namespace limn {

void require_readable(const std::string& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) throw FileError(path, "there is no such file");
    if (std::filesystem::is_directory(status)) throw FileError(path, "is a folder, not a file");
    // Reading a pipe without a writer, or /dev/zero, would never end.
    if (!std::filesystem::is_regular_file(status)) throw FileError(path, "is not a regular file");
    errno = 0;
    if (!std::ifstream(path, std::ios::binary)) throw FileError(path, "cannot be read: " + system_message());
}

std::string read_file(const std::string& path) {
    require_readable(path);
    std::ifstream file(path, std::ios::binary);
    std::string text;
    try {
        char buffer[1 << 16];
        while (file.read(buffer, sizeof buffer) || file.gcount() > 0)
            text.append(buffer, static_cast<std::size_t>(file.gcount()));
    } catch (const std::bad_alloc&) {
        throw FileError(path, "is larger than the memory");
    }
    if (!file.eof()) throw FileError(path, "reading failed");
    return text;
}

}  // namespace limn
