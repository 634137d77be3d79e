/// \file
/// Counts of the edges of a mesh.
#pragma once

#include <cstddef>

#include "limn/scene/shape/mesh.h"

namespace limn {

/// Numbers of edges, by the number of triangles that share them.
struct EdgeCounts {
    std::size_t edges = 0;        ///< number of all edges
    std::size_t open = 0;         ///< edges of one triangle: the border of a hole or of the surface
    std::size_t nonmanifold = 0;  ///< edges of more than two triangles: branching or duplicate surfaces

    /// True if the surface has no border.
    bool is_closed() const { return open == 0; }
};

/// Counts the edges of a mesh, in O(n log n).
///
/// - Two triangles share an edge if it has the same two end points in both. Vertices at the same position are one
///   point, whatever their indices, because files split vertices along seams.
/// - Triangles of exactly zero area are ignored.
/// - A vertex in the interior of another triangle's edge does not divide that edge.
EdgeCounts count_edges(const Mesh& mesh);

}  // namespace limn
