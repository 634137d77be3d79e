#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/obj_parse.h"
#include "limn/shape/mesh.h"

namespace limn {

struct ObjMesh {
    // Slot 0 is for faces without a material, slot i + 1 for ObjFile::materials[i]. Empty if no face is usable.
    MeshData data;
    std::size_t dropped_faces = 0, degenerate_triangles = 0;
    std::vector<std::string> warnings;
};

/// Cuts faces into triangles and leaves out those without an area. If no face names a normal or texture coordinate, the
/// vertices are those of the file; otherwise there is one for every combination that occurs, and a corner that names no
/// normal, or one of length zero, gets its face's, one that names no texture coordinate gets (0, 0).
ObjMesh build_mesh(const ObjFile& file);

}  // namespace limn
