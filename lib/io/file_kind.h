// What a file is by its contents, whatever its name.
#pragma once

#include <optional>
#include <string_view>

#include "io/image_codec.h"

namespace limn {

enum class ModelFormat { gltf, ply, stl };

struct FileKind {
    std::string_view name{};             // "a PNG picture", "UTF-16 text", "a PLY model" and the like; empty if unknown
    std::optional<FileFormat> format{};  // of a picture that limn reads
    bool may_be_text = false;            // the mark is so short that a text may begin with it
    std::optional<ModelFormat> model{};  // one that limn reads, beside OBJ, which has no mark
};

FileKind kind_of_contents(std::string_view contents);

// Of an STL: 80 bytes of any text, the number of triangles, and 50 bytes for each.
inline constexpr std::size_t kStlHeader = 84, kStlTriangle = 50;
bool is_binary_stl(std::string_view contents);
// Whether it begins as an ASCII STL does, with text; so may the header of a binary one.
bool begins_with_solid(std::string_view contents);

}  // namespace limn
