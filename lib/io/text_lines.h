// Splits the text of an OBJ, MTL, PLY or STL file into lines and words, and parses numbers independently of the locale.
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace limn {

inline constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";  // in UTF-8

// The syntax of lines. In a `plain` text, lines hold only words. In the syntax of OBJ, a line that ends in a backslash
// continues on the next line unless it is a comment, and a word that begins with '#' begins a comment.
enum class LineForm { as_in_obj, plain };

// Reads a text line by line. A byte order mark is skipped. A line ends in LF, CR LF or CR; the last line needs no end.
// A line that continues counts as one logical line. The text is not owned.
class TextLines {
public:
    explicit TextLines(std::string_view text, std::string path = {}, LineForm form = LineForm::as_in_obj);
    // Moves to the next line. Returns false if there is none.
    bool next();
    // Returns the number of the current line, counted from 1. A line may continue over several physical lines; their
    // first one counts.
    std::size_t number() const { return number_; }
    // Returns the text after the current line.
    std::string_view rest() const { return rest_of_text_; }
    // Returns the words of the current line, up to a comment. They are valid until the next call of next().
    std::vector<std::string_view> words() const;
    // Returns the rest of the current line after the first `skipped` words, without blanks around it. A name may
    // contain blanks, but ends at a comment. A '#' before a digit is part of the name, because names like "Material
    // #25" are common. The name is valid until the next call of next().
    std::string_view name(std::size_t skipped = 1) const;

    // Throws a FileError that names the file and the current line.
    [[noreturn]] void fail(const std::string& problem) const;
    // Returns parse_float(word); fails if it has no value.
    float require_number(std::string_view word) const;

private:
    std::string path_;
    LineForm form_;
    std::string_view rest_of_text_;
    std::string line_;
    std::size_t number_ = 0, next_number_ = 1;
};

// Counts the lines that a reader does not know.
struct PassedOver {
    std::size_t count = 0, first = 0;

    void add(std::size_t line) {
        if (count++ == 0) first = line;
    }
    // Returns a warning with the number of lines. \pre count > 0
    std::string warning() const;
};

// Returns the float32 that is nearest to a decimal number, ties to even. Returns std::nullopt if the word is not a
// number, or if its value is not finite.
std::optional<float> parse_float(std::string_view word);

inline bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

// Returns a word with its ASCII letters in lower case.
std::string in_lower_case(std::string_view word);

// Returns a word of a file for a message: at most 40 bytes of it, with control characters replaced.
std::string shortened(std::string_view word);
// Returns shortened(word) in single quotes.
std::string in_quotes(std::string_view word);

// Appends the shortest decimal number that parses to `value`.
void append_number(std::string& text, float value);

}  // namespace limn
