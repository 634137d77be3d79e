// Declares the steps of reading an OBJ, each of which has a source of its own. Counts and warnings are stored in the
// model.
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

// A corner of a face: indices into the arrays of an ObjFile, or kNone.
struct ObjCorner {
    static constexpr int kNone = -1;
    int position = kNone, uv = kNone, normal = kNone;
    bool operator==(const ObjCorner&) const = default;
};

struct ObjFace {
    std::size_t line = 0, first_corner = 0, corner_count = 0;
    std::uint32_t slot = 0;  // the material slot: 0 without a material, i + 1 for Model::materials[i]
};

// An mtllib statement.
struct ObjLibrary {
    std::string names;  // the rest of the line
    std::size_t line = 0;
};

// The contents of an OBJ as arrays. All indices have been checked.
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

// Checks every line of an OBJ and returns a text that tinyobjloader cannot misread. tinyobjloader reads well-formed
// text correctly, but reports no error for much that is not: a byte order mark, a continued line, an index that wraps
// around, 1e40, "nan". The returned text has only v, vt, vn and f, with exact float32 values and positive indices. All
// other statements are stored in `file` and `model`, and so are the faces without their corners.
// \throws FileError naming `path` and the line if a number or a corner is malformed, if a value is not a finite
// float32, or if a relative index refers to an element before the first
// \throws FileError naming `path` if there are lines, but no line is a statement of an OBJ
std::string clean_obj(std::string_view text, const std::string& path, ObjFile& file, Model& model);

// Parses an OBJ: checks it with clean_obj() and gives the result to tinyobjloader. Sets the numbers of vertices and
// faces of the model.
// \throws FileError naming `path` and the line, as clean_obj(), and if an index is out of range
ObjFile parse_obj(std::string_view text, const std::string& path, Model& model);

// Cuts the faces into triangles and leaves out those without an area. The mesh is empty if no face is usable.
//
// If no face names a normal or a texture coordinate, the mesh has the vertices of the file. Otherwise it has one vertex
// for each combination of position, normal and texture coordinate that occurs. A corner that names no normal, or a
// normal of length zero, gets the normal of its face. A corner that names no texture coordinate gets (0, 0).
MeshData build_mesh(const ObjFile& file, Model& model);

// Returns the default material, then a material for each name in Model::materials, as the table in limn/io/obj.h says.
// A missing material is replaced by the default one, with a warning.
// \throws FileError naming the MTL and the line if a number in it is missing or malformed
std::vector<std::shared_ptr<const Material>> load_obj_materials(const ObjFile& file, const std::string& obj_path,
                                                                const ObjOptions& options, Model& model);

}  // namespace limn
