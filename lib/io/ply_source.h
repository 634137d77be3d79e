// The header and the numbers of a PLY file (Turk, The PLY Polygon File Format, 1994), whichever way it is written.
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

// Of a value of an integer type, for a message.
std::string integer_text(double value);

struct PlyProperty {
    std::string name;
    PlyType type;
    std::optional<PlyType> count_type{};  // of a list
};

struct PlyElement {
    std::string name;
    std::uint64_t count;
    std::vector<PlyProperty> properties{};

    // The place of the first property of one of these names, among lists or among numbers.
    std::optional<std::size_t> find(std::initializer_list<std::string_view> names, bool is_list = false) const;
};

class PlySource {
public:
    /// Reads the header. \throws FileError naming `path` and the line
    PlySource(std::string_view bytes, const std::string& path, std::vector<std::string>& warnings);

    const std::vector<PlyElement>& elements() const { return elements_; }

    // The next row of an element, one value for each property; that of a list has no meaning, and of the list `wanted`
    // `list` gets the numbers. \throws FileError naming the place
    void read_row(const PlyElement& element, std::optional<std::size_t> wanted, std::vector<double>& values,
                  std::vector<double>& list);

    // What lies behind the last row, or nothing.
    void warn_of_rest(std::vector<std::string>& warnings) const;

    /// \throws FileError naming the line, or the byte of a binary file
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
    Cursor data_;                          // of a binary file
    std::vector<std::string_view> words_;  // of the line of a text that is being read, the last first
};

}  // namespace limn
