/// \file
/// Parsing of the values of command-line options. Parsing is strict: the whole text must be one finite value in its
/// range. All functions throw an ArgumentError that names the option and the text. They do not depend on the locale.
#pragma once

#include <array>
#include <charconv>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "limn/image/image.h"
#include "options.h"

namespace limn::app {

/// Throws ArgumentError("OPTION TEXT: PROBLEM").
[[noreturn]] void refuse(std::string_view option, std::string_view text, std::string_view problem);

/// Parses a decimal integer in [lowest, highest].
template <class Integer>
Integer parse_integer(std::string_view option, std::string_view text, Integer lowest, Integer highest) {
    Integer value{};
    const char* const last = text.data() + text.size();
    const auto [end, problem] = std::from_chars(text.data(), last, value);
    const bool overflow = problem == std::errc::result_out_of_range && end == last;
    if (!overflow && (problem != std::errc{} || end != last)) refuse(option, text, "is not a whole number");
    if (overflow || value < lowest || value > highest)
        refuse(option, text, "must be in " + std::to_string(lowest) + " .. " + std::to_string(highest));
    return value;
}

/// Returns a function for Options::add that stores the name of a file, which must not be empty.
Use file_name(std::string option, std::string& path);
/// Returns a function for Options::add that appends the name of a file, which must not be empty.
Use file_names(std::string option, std::vector<std::string>& paths);

/// Returns a function for Options::add that appends the name of a picture to write. Refuses an unknown suffix.
Use picture_names(std::string option, std::vector<std::string>& paths);

/// Parses a finite number.
double parse_number(std::string_view option, std::string_view text);
/// Parses a finite number over 0.
double parse_positive(std::string_view option, std::string_view text);

/// Parses three finite numbers, separated by commas.
std::array<double, 3> parse_triple(std::string_view option, std::string_view text);

/// The longest side of a picture in pixels. With this limit a mistyped size is refused early, not when memory runs out.
inline constexpr int kLongestSide = 65536;

/// The size of a picture in pixels.
struct Size {
    int width = 0, height = 0;
};
/// Parses WIDTHxHEIGHT. Each side is in 1 to kLongestSide.
Size parse_size(std::string_view option, std::string_view text);

/// Parses LEFT,TOP,RIGHT,BOTTOM in pixels, each in 0 to kLongestSide. Refuses bounds without pixels.
PixelBounds parse_bounds(std::string_view option, std::string_view text);

/// Returns the arguments as one line, quoted for a shell.
std::string command_line(int argc, const char* const* argv);

}  // namespace limn::app
