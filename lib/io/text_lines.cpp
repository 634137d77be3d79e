#include "io/text_lines.h"

#include <charconv>
#include <cmath>
#include <locale>
#include <sstream>

namespace limn {

namespace {

constexpr std::string_view kBlanks = " \t\v\f";

std::string_view trim(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

// Takes the next physical line off the front of `text`.
std::string_view take_line(std::string_view& text) {
    const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
    text.remove_prefix(line.size());
    if (!text.empty()) text.remove_prefix(text.substr(0, 2) == "\r\n" ? 2 : 1);
    return line;
}

}  // namespace

TextLines::TextLines(std::string_view text) : rest_of_text_(text) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
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
        continues = part.ends_with('\\') && !trim(line_).starts_with('#');  // comments may end in a Windows folder
        if (continues) line_.back() = ' ';
    }
    return true;
}

std::vector<std::string_view> TextLines::words() const {
    std::vector<std::string_view> words;
    std::string_view text = trim(line_);
    while (!text.empty() && text.front() != '#') {
        const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
        words.push_back(word);
        text = trim(text.substr(word.size()));
    }
    return words;
}

std::string_view TextLines::rest() const {
    const std::string_view line = trim(line_);
    const std::size_t end = line.find_first_of(kBlanks);
    return end == std::string_view::npos ? std::string_view{} : trim(line.substr(end));
}

std::optional<float> parse_float(std::string_view word) {
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    const char* end = word.data() + word.size();
    float value = 0;
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (error == std::errc::invalid_argument || stop != end) return std::nullopt;
    if (error == std::errc::result_out_of_range) {
        // Too large, or so small that it is zero: a stream in the classic locale tells which.
        std::istringstream stream{std::string(word)};
        stream.imbue(std::locale::classic());
        if (!(stream >> value)) return std::nullopt;
    }
    if (!std::isfinite(value)) return std::nullopt;
    return value;
}

void append_number(std::string& text, float value) {
    char buffer[32];
    text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

}  // namespace limn
