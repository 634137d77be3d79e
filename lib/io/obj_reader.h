// The steps of load_obj, each in a source of its own. What they count and warn of goes into the model.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limn/io/obj.h"

namespace limn {

// Places in the arrays of an ObjFile; kNone where the corner has no such thing.
struct ObjCorner {
    static constexpr int kNone = -1;
    int position = kNone, uv = kNone, normal = kNone;
    bool operator==(const ObjCorner&) const = default;
};

struct ObjFace {
    std::size_t line = 0, first_corner = 0, corner_count = 0;
    std::uint32_t slot = 0;  // 0 without a material, i + 1 for Model::materials[i]
};

struct ObjLibrary {
    std::string names;  // what stands behind mtllib
    std::size_t line = 0;
};

// An OBJ as plain arrays, checked.
struct ObjFile {
    std::vector<Float3> positions, normals;
    std::vector<Float2> uvs;
    std::vector<ObjCorner> corners;
    std::vector<ObjFace> faces;
    std::vector<ObjLibrary> libraries;

    std::span<const ObjCorner> corners_of(const ObjFace& face) const {
        return std::span(corners).subspan(face.first_corner, face.corner_count);
    }
};

// What stands between a user's OBJ file and tinyobjloader, which reads well-formed text right, but is silent about much
// that is not (a byte order mark, a continued line, an index that wraps, 1e40, "nan"). Every line is checked here, and
// v, vt, vn and f are written anew in the one form that it cannot misread: exact float32, positive indices. All else
// goes into `file`, the faces without their corners. \throws FileError naming `path` and the line: a malformed number
// or corner, a value that is not a finite float32, a relative index that reaches before the first element; naming
// `path`: lines, but none that an OBJ has
std::string clean_obj(std::string_view text, const std::string& path, ObjFile& file, Model& model);

/// \throws FileError naming `path` and the line of what is wrong
ObjFile parse_obj(std::string_view text, const std::string& path, Model& model);

/// Cuts faces into triangles and leaves out those without an area; empty if no face is usable. If no face names a
/// normal or texture coordinate, the vertices are those of the file; otherwise there is one for every combination that
/// occurs, and a corner that names no normal, or one of length zero, gets its face's, one that names no texture
/// coordinate gets (0, 0).
MeshData build_mesh(const ObjFile& file, Model& model);

/// The fallback, then a material for each name in Model::materials, as the table in limn/io/obj.h says. What is missing
/// is replaced by the fallback, with a warning. \throws FileError naming the MTL and the line of a malformed number
std::vector<std::shared_ptr<const Material>> load_obj_materials(const ObjFile& file, const std::string& obj_path,
                                                                const ObjOptions& options, Model& model);

}  // namespace limn
