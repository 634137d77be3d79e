// The lines of an OBJ, MTL, PLY or STL file, however it was written, and the numbers in them, whatever the locale.
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace limn {

inline constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";  // of UTF-8

// What a line may hold beside words. As in OBJ: one that ends in a backslash and is no comment continues on the next,
// and a word that begins with '#' begins a comment.
enum class LineForm { as_in_obj, plain };

// Steps through logical lines: a byte order mark is skipped; LF, CR LF and CR end a line; the last one needs no end.
class TextLines {
public:
    explicit TextLines(std::string_view text, std::string path = {}, LineForm form = LineForm::as_in_obj);
    // Moves to the next line; false behind the last.
    bool next();
    // Of the first physical line, counted from 1.
    std::size_t number() const { return number_; }
    // What stands behind the line.
    std::string_view rest() const { return rest_of_text_; }
    // Words between blanks, up to a comment.
    std::vector<std::string_view> words() const;
    // What stands behind the first `skipped` words, without surrounding blanks: a name may hold blanks, but ends at a
    // comment. Names like "Material #25" are common, so a '#' before a digit is part of the name.
    std::string_view name(std::size_t skipped = 1) const;

    /// \throws FileError naming the file and the line
    [[noreturn]] void fail(const std::string& problem) const;
    float require_number(std::string_view word) const;

private:
    std::string path_;
    LineForm form_;
    std::string_view rest_of_text_;
    std::string line_;
    std::size_t number_ = 0, next_number_ = 1;
};

// Lines that a reader knows no use for.
struct PassedOver {
    std::size_t count = 0, first = 0;

    void add(std::size_t line) {
        if (count++ == 0) first = line;
    }
    std::string warning() const;
};

// The nearest float32 to a decimal number, ties to even. None if the word is no number, or one that is not finite.
std::optional<float> parse_float(std::string_view word);

inline bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

// ASCII letters alone.
std::string in_lower_case(std::string_view word);

// A word of a file for a message: shortened, and without control characters.
std::string shortened(std::string_view word);
std::string in_quotes(std::string_view word);

// The shortest decimal that reads back as `value`.
void append_number(std::string& text, float value);

}  // namespace limn
