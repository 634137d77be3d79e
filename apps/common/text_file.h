/// \file
/// Text results: reports and tables. The path "-" is stdout. Also the check that no output replaces an input.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace limn::app {

/// Without line breaks and other control characters, which names in files may hold and a terminal would follow.
std::string on_one_line(std::string text);

/// A line of a table.
std::string table_row(std::string_view name, std::string_view value);

/// Throws the FileError that write_text would throw for a reason that can be known beforehand.
void check_text_path(const std::string& path);

/// Writes stdout, or a file as save_text does. \throws FileError
void write_text(const std::string& path, std::string_view text);

/// \throws ArgumentError if two of the outputs, or an output and an input, are the same file; "-" and "" do not count
void check_distinct(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

}  // namespace limn::app
