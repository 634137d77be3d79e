/// \file
/// How the triangles of a mesh join.
#pragma once

#include <cstddef>

#include "limn/shape/mesh.h"

namespace limn {

/// Edges by the number of triangles that share them.
struct EdgeCounts {
    std::size_t edges = 0;        ///< all of them
    std::size_t open = 0;         ///< of one triangle: the border of a hole or of the surface
    std::size_t nonmanifold = 0;  ///< of more than two: where sheets meet, or triangles lie twice

    /// Whether the surface has no border.
    bool is_closed() const { return open == 0; }
};

/// Two triangles share an edge if it has the same two ends. Vertices at the same position are one end, whatever their
/// indices (files split vertices along seams). Triangles of exactly zero area are left out. A vertex within another
/// triangle's edge does not cut it. O(n log n).
EdgeCounts count_edges(const Mesh& mesh);

}  // namespace limn
