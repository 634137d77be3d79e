// Recognises the kind of a file by its contents. The name of the file does not count.
#pragma once

#include <optional>
#include <string_view>

#include "io/picture_formats.h"

namespace limn {

enum class ModelFormat { gltf, ply, stl };

struct FileKind {
    std::string_view name{};             // "a PNG picture", "UTF-16 text", "a PLY model" ...; empty if unknown
    std::optional<FileFormat> format{};  // the format of a picture, if limn reads it
    bool may_be_text = false;            // true if a text may begin with the same bytes
    std::optional<ModelFormat> model{};  // the format of a model, if limn reads it; an OBJ is not recognised
};

// Returns the kind of a file with these contents; an empty FileKind if it is unknown.
FileKind kind_of_contents(std::string_view contents);

// The sizes in a binary STL, in bytes. The header is 80 bytes of any text and the number of triangles.
inline constexpr std::size_t kStlHeader = 84, kStlTriangle = 50;
// Returns true if the size of the file is exactly the size of a binary STL with the number of triangles that it states.
bool is_binary_stl(std::string_view contents);
// Returns true if the contents begin with the word "solid" and no zero byte is among the first kStlHeader. An ASCII STL
// begins in this way; the header of a binary one may, too.
bool begins_with_solid(std::string_view contents);

}  // namespace limn
