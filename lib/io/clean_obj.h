// What stands between a user's OBJ file and tinyobjloader, which reads well-formed text right, but is silent about much
// that is not (a byte order mark, a continued line, an index that wraps, 1e40, "nan"). Every line is checked here and
// written anew in the one form that it cannot misread.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace limn {

struct ObjLibrary {
    std::string names;  // what stands behind mtllib
    std::size_t line = 0;
};

struct CleanObj {
    // v, vt, vn, f with at least one corner, and usemtl; numbers are exact float32, indices positive, and the material
    // is given by its place in `materials`.
    std::string text;
    struct FacePart {
        std::size_t face, line;  // the face's number among all of the file, from 0
    };
    std::vector<FacePart> face_parts;  // one for each f in `text`: a long face is stated in several
    std::size_t face_count = 0;
    std::vector<std::string> materials;
    std::vector<ObjLibrary> libraries;
    std::vector<std::string> warnings;
};

/// \throws FileError naming `path` and the line: a malformed number or corner, a value that is not a finite float32, a
/// relative index that reaches before the first element; naming `path`: lines, but none that an OBJ has
CleanObj clean_obj(std::string_view text, const std::string& path);

}  // namespace limn
