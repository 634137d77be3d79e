// Reads the header and the numbers of a PLY file in any of its three forms: text, or binary of either byte order (Turk,
// The PLY Polygon File Format, 1994).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/bytes.h"
#include "io/text_lines.h"

namespace limn {

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

inline bool is_integer(PlyType type) { return type < PlyType::float32; }

// Returns the text of an integer for a message.
std::string integer_text(double value);

struct PlyProperty {
    std::string name;
    PlyType type;
    std::optional<PlyType> count_type{};  // the type of a list's length; std::nullopt for a number
};

struct PlyElement {
    std::string name;
    std::uint64_t count;
    std::vector<PlyProperty> properties{};

    // Returns the index of the first property that has one of these names. Considers only lists if `is_list` is true,
    // else only numbers.
    std::optional<std::size_t> find(std::initializer_list<std::string_view> names, bool is_list = false) const;
};

// Reads a PLY file row by row. Errors are FileErrors that name the file and the line, or the byte of a binary file. The
// bytes are not owned.
class PlySource {
public:
    // Reads the header.
    PlySource(std::string_view bytes, const std::string& path, std::vector<std::string>& warnings);

    const std::vector<PlyElement>& elements() const { return elements_; }

    // Reads the next row of an element. `values` gets one value for each property, 0 for a list. If `wanted` is the
    // index of a list, `list` gets the numbers of that list.
    void read_row(const PlyElement& element, std::optional<std::size_t> wanted, std::vector<double>& values,
                  std::vector<double>& list);

    // Adds a warning if anything follows the last row.
    void warn_of_rest(std::vector<std::string>& warnings) const;

    // Throws a FileError with a problem at the current place.
    [[noreturn]] void fail(const std::string& problem) const;

private:
    enum class Form { ascii, little, big };

    void read_header(std::vector<std::string>& warnings);
    void read_format(const std::vector<std::string_view>& words);
    void add_element(const std::vector<std::string_view>& words);
    void add_property(const std::vector<std::string_view>& words);
    PlyType type_of(std::string_view word) const;
    double value(PlyType type);
    double value_of_word(PlyType type);
    std::size_t rest_size() const;

    std::string_view bytes_;
    std::string path_;
    TextLines lines_;
    std::optional<Form> form_;
    std::vector<PlyElement> elements_;
    Cursor data_;                          // the rest of a binary file
    std::vector<std::string_view> words_;  // the rest of the current line of a text, in reverse order
};

}  // namespace limn
