// OBJ files as plain arrays, checked.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "io/clean_obj.h"
#include "limn/core/vec.h"

namespace limn {

// Places in the arrays of an ObjFile; kNone where the corner has no such thing.
struct ObjCorner {
    static constexpr int kNone = -1;
    int position = kNone, uv = kNone, normal = kNone;
    auto operator<=>(const ObjCorner&) const = default;
};

struct ObjFace {
    static constexpr std::size_t kNoMaterial = static_cast<std::size_t>(-1);
    std::size_t number = 0;  // among all faces of the file, from 0
    std::size_t line = 0;
    std::size_t first_corner = 0, corner_count = 0;
    std::size_t material = kNoMaterial;  // place in ObjFile::materials
};

struct ObjFile {
    std::vector<Float3> positions, normals;
    std::vector<Float2> uvs;
    std::vector<ObjCorner> corners;
    std::vector<ObjFace> faces;          // those with at least one corner
    std::size_t face_count = 0;          // in the file
    std::vector<std::string> materials;  // as the file names them
    std::vector<ObjLibrary> libraries;
    std::vector<std::string> warnings;
};

/// \throws FileError naming `path` and the line of what is wrong
ObjFile parse_obj(std::string_view text, const std::string& path);

}  // namespace limn
