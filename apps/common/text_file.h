/// \file
/// Output of text: reports and tables. The path "-" is stdout. Also a check that no output replaces an input.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace limn::app {

/// Returns the text with line breaks replaced by spaces and other control characters by "?". Names from files may have
/// such characters, and a terminal would execute them.
std::string on_one_line(std::string text);

/// Returns a line of a table: the name, and the value on one line.
std::string table_row(std::string_view name, std::string_view value);

/// Checks that a file can be written, as far as that is known beforehand. \throws FileError as write_text
void check_text_path(const std::string& path);

/// Writes the text to stdout, or to a file as save_text does. \throws FileError
void write_text(const std::string& path, std::string_view text);

/// Checks that the outputs are different files and none of them is an input. "-" and "" are ignored.
/// \throws ArgumentError if two outputs, or an output and an input, are the same file
void check_distinct(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

}  // namespace limn::app
