/// \file
/// Files of any kind.
#pragma once

#include <string>
#include <string_view>

namespace limn {

/// Makes `text` the contents of a file, which appears whole or not at all, as save_image (image_io.h) says.
/// \throws FileError naming the file
void save_text(std::string_view text, const std::string& path);

/// Throws now what save_text would throw later because the folder is missing, it may not be written, or the path is not
/// of a regular file.
void check_text_writable(const std::string& path);

/// The file that save_text and save_image would write for `path`: absolute, behind all links, also those that lead to a
/// file that does not exist yet. \throws FileError if links lead in a circle
std::string file_behind_links(const std::string& path);

}  // namespace limn
