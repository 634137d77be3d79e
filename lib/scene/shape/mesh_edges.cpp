#include "limn/scene/shape/mesh_edges.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <tuple>

#include "geometry/mesh_triangle.h"
#include "scene/shape/position_numbers.h"

namespace limn {

namespace {

// Returns an edge as one number. Both directions give the same number.
std::uint64_t edge(std::uint32_t a, std::uint32_t b) { return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b); }

}  // namespace

std::vector<std::uint32_t> position_numbers(const std::vector<Float3>& vertices) {
    std::vector<std::uint32_t> order(vertices.size()), numbers(vertices.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto key = [&vertices](std::uint32_t i) {
        return std::tie(vertices[i].x, vertices[i].y, vertices[i].z);  // compares -0 and 0 as equal
    };
    std::sort(order.begin(), order.end(), [&key](std::uint32_t i, std::uint32_t j) { return key(i) < key(j); });
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i > 0 && key(order[i - 1]) != key(order[i])) ++number;
        numbers[order[i]] = number;
    }
    return numbers;
}

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
