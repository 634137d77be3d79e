/// \file
/// Writing text files, and finding the file behind links.
#pragma once

#include <string>
#include <string_view>

namespace limn {

/// Writes `text` to a file. The file appears whole or not at all; save_image (limn/io/image_io.h) says how.
/// \throws FileError that names the file
void save_text(std::string_view text, const std::string& path);

/// Throws the error that save_text would throw, as far as it can be known beforehand. Writes a temporary file in the
/// folder and deletes it.
/// \throws FileError if the folder is missing, the folder or the file may not be written, `path` isn't a regular file,
/// or the disk is full
void check_text_writable(const std::string& path);

/// Returns the absolute path of the file that save_text and save_image write for `path`: all links are resolved. The
/// file need not exist yet.
/// \throws FileError if links lead in a circle
std::string file_behind_links(const std::string& path);

}  // namespace limn
