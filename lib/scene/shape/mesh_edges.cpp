#include "limn/scene/shape/mesh_edges.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "geometry/mesh_triangle.h"
#include "scene/shape/position_numbers.h"

namespace limn {

namespace {

// Returns an edge as one number. Both directions give the same number.
std::uint64_t edge(std::uint32_t a, std::uint32_t b) { return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b); }

}  // namespace

EdgeCounts count_edges(const Mesh& mesh) {
    // List the three sides of each triangle that has an area.
    const MeshData& data = mesh.data();
    const MeshView view{data.vertices, data.triangles, {}, {}, {}};
    const std::vector<std::uint32_t> numbers = position_numbers(data.vertices);
    std::vector<std::uint64_t> sides;
    sides.reserve(3 * data.triangles.size());
    for (std::size_t i = 0; i < data.triangles.size(); ++i) {
        if (is_degenerate(triangle_vertices(view, i))) continue;
        const Index3& t = data.triangles[i];
        const std::uint32_t a = numbers[t.a], b = numbers[t.b], c = numbers[t.c];
        sides.insert(sides.end(), {edge(a, b), edge(b, c), edge(c, a)});
    }
    std::sort(sides.begin(), sides.end());

    // Count the equal sides.
    EdgeCounts counts;
    for (auto first = sides.begin(); first != sides.end();) {
        const auto last = std::find_if(first, sides.end(), [first](std::uint64_t side) { return side != *first; });
        ++counts.edges;
        if (last - first == 1) ++counts.open;
        if (last - first > 2) ++counts.nonmanifold;
        first = last;
    }
    return counts;
}

}  // namespace limn
