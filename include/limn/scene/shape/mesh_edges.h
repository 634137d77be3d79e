/// \file
/// Counts of the edges of a mesh.
#pragma once

#include <cstddef>

#include "limn/scene/shape/mesh.h"

namespace limn {

/// Numbers of the edges of a mesh.
struct EdgeCounts {
    std::size_t edges = 0;  ///< number of all edges
    /// Number of edges that belong to a single triangle: the border of a hole or of the surface.
    std::size_t open = 0;
    /// Number of edges that belong to more than two triangles: branching or duplicate surfaces.
    std::size_t nonmanifold = 0;

    /// Returns true if no edge is open. The orientation of triangles does not count here; in CompiledScene::open_edges
    /// it does.
    bool is_closed() const { return open == 0; }
};

/// Counts the edges of a mesh, in O(n log n) for n vertices and triangles.
///
/// - Two triangles share an edge if both have the same two end points. Vertices at the same position are one
///   point, whatever their indices, because files split vertices along seams.
/// - Triangles of exactly zero area are ignored.
/// - A vertex in the interior of another triangle's edge does not divide that edge.
EdgeCounts count_edges(const Mesh& mesh);

}  // namespace limn
