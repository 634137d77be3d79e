/// \file
/// Values of command-line options, read strictly: the whole text is one finite value within its range. Everything
/// throws ArgumentError with a message that holds the option and the text. The locale plays no part.
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

/// \throws ArgumentError "OPTION TEXT: PROBLEM", always
[[noreturn]] void refuse(std::string_view option, std::string_view text, std::string_view problem);

/// A decimal integer in [lowest, highest].
template <class Integer>
Integer parse_integer(std::string_view option, std::string_view text, Integer lowest, Integer highest) {
    Integer value{};
    const char* const last = text.data() + text.size();
    const auto [end, problem] = std::from_chars(text.data(), last, value);
    const bool overflow = problem == std::errc::result_out_of_range && end == last;
    if (!overflow && (problem != std::errc{} || end != last)) refuse(option, text, "is not a whole number");
    if (overflow || value < lowest || value > highest)
        refuse(option, text, "must lie in " + std::to_string(lowest) + " .. " + std::to_string(highest));
    return value;
}

/// The name of a file, which must not be empty, or of several: for Options::add.
Use file_name(std::string option, std::string& path);
Use file_names(std::string option, std::vector<std::string>& paths);

/// The same of pictures to be written: what is wrong with the name alone is wrong in the arguments.
Use picture_names(std::string option, std::vector<std::string>& paths);

double parse_number(std::string_view option, std::string_view text);
/// Over 0.
double parse_positive(std::string_view option, std::string_view text);

/// Three numbers with commas between them.
std::array<double, 3> parse_triple(std::string_view option, std::string_view text);

/// No side is longer than this: a mistyped size is refused at once and not when memory runs out.
inline constexpr int kLongestSide = 65536;

struct Size {
    int width = 0, height = 0;
};
/// WIDTHxHEIGHT in pixels.
Size parse_size(std::string_view option, std::string_view text);

/// LEFT,TOP,RIGHT,BOTTOM in pixels, of which there is at least one.
PixelBounds parse_bounds(std::string_view option, std::string_view text);

/// The arguments as one line that a shell would read back.
std::string command_line(int argc, const char* const* argv);

}  // namespace limn::app
