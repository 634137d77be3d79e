#include "io/text_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <locale>
#include <sstream>
#include <utility>

#include "limn/math/error.h"

namespace limn {

namespace {

constexpr std::string_view kBlanks = " \t\v\f";

std::string_view trim(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

// Removes a physical line from the front of `text` and returns it without its end.
std::string_view take_line(std::string_view& text) {
    const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
    text.remove_prefix(line.size());
    if (!text.empty()) text.remove_prefix(text.substr(0, 2) == "\r\n" ? 2 : 1);
    return line;
}

}  // namespace

TextLines::TextLines(std::string_view text, std::string path, LineForm form)
    : path_(std::move(path)), form_(form), rest_of_text_(text) {
    if (text.substr(0, 3) == kByteOrderMark) rest_of_text_.remove_prefix(3);
}

bool TextLines::next() {
    if (rest_of_text_.empty()) return false;
    number_ = next_number_;
    line_.clear();
    for (bool continues = true; continues && !rest_of_text_.empty();) {
        const std::string_view part = take_line(rest_of_text_);
        ++next_number_;
        line_ += part;
        // Don't continue a comment: it may end in the path of a Windows folder.
        continues = part.ends_with('\\') && !trim(line_).starts_with('#');
        continues = continues && form_ == LineForm::as_in_obj;
        if (continues) line_.back() = ' ';
    }
    return true;
}

std::vector<std::string_view> TextLines::words() const {
    std::vector<std::string_view> words;
    std::string_view text = trim(line_);
    while (!text.empty() && (text.front() != '#' || form_ == LineForm::plain)) {
        const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
        words.push_back(word);
        text = trim(text.substr(word.size()));
    }
    return words;
}

std::string_view TextLines::name(std::size_t skipped) const {
    std::string_view text = trim(line_);
    for (; skipped > 0; --skipped) text = trim(text.substr(std::min(text.size(), text.find_first_of(kBlanks))));
    const auto begins_comment = [text](std::size_t i) {
        const bool is_number = i + 1 < text.size() && text[i + 1] >= '0' && text[i + 1] <= '9';
        return text[i] == '#' && !is_number && (i == 0 || kBlanks.find(text[i - 1]) != std::string_view::npos);
    };
    std::size_t end = 0;
    while (end < text.size() && !begins_comment(end)) ++end;
    return trim(text.substr(0, end));
}

void TextLines::fail(const std::string& problem) const {
    throw FileError(path_, "line " + std::to_string(number_) + ": " + problem);
}

float TextLines::require_number(std::string_view word) const {
    const std::optional<float> value = parse_float(word);
    if (!value) fail(in_quotes(word) + " is not a number within the range of float32");
    return *value;
}

std::string PassedOver::warning() const {
    return std::to_string(count) + (count == 1 ? " line was" : " lines were") + " passed over; the first is line " +
           std::to_string(first);
}

std::optional<float> parse_float(std::string_view word) {
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    const char* end = word.data() + word.size();
    float value = 0;
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (error == std::errc::invalid_argument || stop != end) return std::nullopt;
    if (error == std::errc::result_out_of_range) {
        // The number is too large, or so small that it rounds to zero. Only a stream distinguishes the two.
        std::istringstream stream{std::string(word)};
        stream.imbue(std::locale::classic());
        if (!(stream >> value)) return std::nullopt;
    }
    if (!std::isfinite(value)) return std::nullopt;
    return value;
}

std::string in_lower_case(std::string_view word) {
    std::string text(word);
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

std::string shortened(std::string_view word) {
    constexpr std::size_t kLongest = 40;
    std::string text(word.substr(0, kLongest));
    for (char& c : text)
        if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
    return word.size() > kLongest ? text + "..." : text;
}

std::string in_quotes(std::string_view word) { return "'" + shortened(word) + "'"; }

void append_number(std::string& text, float value) {
    char buffer[32];
    text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

}  // namespace limn
