#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace limn {

/// Makes `bytes` the contents of the file `path`, or leaves everything as it was: a temporary file beside it is
/// written, read back, flushed to disk and renamed. A file that was there keeps its permissions; a link is followed.
/// \throws FileError
void replace_file(const std::string& path, std::span<const std::byte> bytes);

/// Throws what replace_file would throw for a reason that can be known beforehand: the folder, permissions, a disk
/// without a free block.
void check_replaceable(const std::string& path);

}  // namespace limn
