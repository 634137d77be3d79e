#include "parse.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "limn/io/image_io.h"
#include "limn/math/error.h"

namespace limn::app {

namespace {

// Splits the text at its commas into `count` parts. `form` is named in the message if there are more or fewer.
template <std::size_t count>
std::array<std::string_view, count> divide(std::string_view option, std::string_view text, const std::string& form) {
    std::array<std::string_view, count> parts;
    std::string_view rest = text;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t comma = rest.find(',');
        if ((comma == std::string_view::npos) != (i == count - 1)) refuse(option, text, "is not of the form " + form);
        parts[i] = rest.substr(0, comma);
        rest.remove_prefix(std::min(rest.size(), parts[i].size() + 1));
    }
    return parts;
}

}  // namespace

void refuse(std::string_view option, std::string_view text, std::string_view problem) {
    throw ArgumentError(std::string(option) + " " + std::string(text) + ": " + std::string(problem));
}

Use file_name(std::string option, std::string& path) {
    return [option = std::move(option), &path](const std::string& text) {
        if (text.empty()) refuse(option, "''", "is not the name of a file");
        path = text;
    };
}

Use file_names(std::string option, std::vector<std::string>& paths) {
    return [option = std::move(option), &paths](const std::string& text) {
        file_name(option, paths.emplace_back())(text);
    };
}

Use picture_names(std::string option, std::vector<std::string>& paths) {
    return [option = std::move(option), &paths](const std::string& text) {
        file_name(option, paths.emplace_back())(text);
        try {
            check_image_name(text);
        } catch (const FileError& e) {
            throw ArgumentError(option + " " + e.what());
        }
    };
}

double parse_number(std::string_view option, std::string_view text) {
    double value = 0;
    const char* const last = text.data() + text.size();
    const auto [end, problem] = std::from_chars(text.data(), last, value);
    if (problem != std::errc{} || end != last || !std::isfinite(value)) refuse(option, text, "is not a finite number");
    return value;
}

double parse_positive(std::string_view option, std::string_view text) {
    const double value = parse_number(option, text);
    if (!(value > 0)) refuse(option, text, "must be over 0");
    return value;
}

std::array<double, 3> parse_triple(std::string_view option, std::string_view text) {
    const std::array parts = divide<3>(option, text, "x,y,z");
    std::array<double, 3> values{};
    for (std::size_t i = 0; i < values.size(); ++i) try {
            values[i] = parse_number(option, parts[i]);
        } catch (const ArgumentError&) {
            refuse(option, text, "has a part that is not a finite number");
        }
    return values;
}

PixelBounds parse_bounds(std::string_view option, std::string_view text) {
    const std::array parts = divide<4>(option, text, "X0,Y0,X1,Y1");
    std::array<int, 4> values{};
    for (std::size_t i = 0; i < values.size(); ++i) try {
            values[i] = parse_integer(option, parts[i], 0, kLongestSide);
        } catch (const ArgumentError&) {
            refuse(option, text, "must be whole numbers in 0 .. " + std::to_string(kLongestSide));
        }
    const PixelBounds bounds{values[0], values[1], values[2], values[3]};
    if (bounds.width() <= 0 || bounds.height() <= 0) refuse(option, text, "holds no pixel");
    return bounds;
}

Size parse_size(std::string_view option, std::string_view text) {
    const std::size_t x = text.find('x');
    if (x == std::string_view::npos) refuse(option, text, "is not of the form WIDTHxHEIGHT");
    const auto side = [&](std::string_view part) {
        try {
            return parse_integer(option, part, 1, kLongestSide);
        } catch (const ArgumentError&) {
            refuse(option, text, "each side must be a whole number in 1 .. " + std::to_string(kLongestSide));
        }
    };
    return {side(text.substr(0, x)), side(text.substr(x + 1))};
}

std::string command_line(int argc, const char* const* argv) {
    // Quote each word that has other characters than these.
    constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,:/@%";
    std::string line;
    for (int i = 0; i < argc; ++i) {
        if (i > 0) line += ' ';
        const std::string word = argv[i];
        if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) {
            line += word;
            continue;
        }
        line += '\'';
        for (const char c : word) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
        line += '\'';
    }
    return line;
}

}  // namespace limn::app
