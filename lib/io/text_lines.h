// The lines of an OBJ or MTL file, however it was written, and the numbers in them, whatever the locale.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace limn {

// Steps through logical lines: a byte order mark is skipped; LF, CR LF and CR end a line; one that ends in a backslash
// and is no comment continues on the next; the last one needs no end.
class TextLines {
public:
    explicit TextLines(std::string_view text);
    // Moves to the next line; false behind the last.
    bool next();
    // Of the first physical line, counted from 1.
    std::size_t number() const { return number_; }
    // Words between blanks, up to one that begins with '#'.
    std::vector<std::string_view> words() const;
    // All behind the first word, without surrounding blanks.
    std::string_view rest() const;

private:
    std::string_view rest_of_text_;
    std::string line_;
    std::size_t number_ = 0, next_number_ = 1;
};

// The nearest float32 to a decimal number, ties to even. None if the word is no number, or one that is not finite.
std::optional<float> parse_float(std::string_view word);

// The shortest decimal that reads back as `value`.
void append_number(std::string& text, float value);

}  // namespace limn
