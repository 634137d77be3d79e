#pragma once

#include <string>

namespace limn {

/// \throws FileError if `path` is missing, not a regular file, or may not be read
void require_readable(const std::string& path);

/// The bytes of a file. \throws FileError
std::string read_file(const std::string& path);

}  // namespace limn
