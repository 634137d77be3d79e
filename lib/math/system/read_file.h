#pragma once

#include <string>

namespace limn {

/// Throws FileError if the file `path` is missing, is not a regular file, or may not be read.
void require_readable(const std::string& path);

/// Returns the bytes of a file. \throws FileError as require_readable() does, if reading fails, or if the memory is too
/// small for the file
std::string read_file(const std::string& path);

}  // namespace limn
