#include "flat/scene.h"

#include <algorithm>

namespace limn::flat {

Place locate(const Scene& scene, std::uint64_t number, BlasId id) {
    // Descend from BLAS to BLAS until the primitive is reached.
    Place place;
    for (;;) {
        // Find the range that has the number.
        const Blas& blas = blas_at(scene, id);
        const auto begin = scene.ranges.begin() + blas.first_range;
        const auto after =
            std::upper_bound(begin, begin + blas.range_count, number,
                             [](std::uint64_t n, const PrimitiveRange& r) { return n < r.first_number; });
        const auto range = after - 1;
        place.range = static_cast<std::uint32_t>(range - scene.ranges.begin());
        place.element = number - range->first_number;
        // Enter the BLAS of an instance or a medium, or return.
        number = place.element;
        if (range->kind == PrimitiveKind::instance) {
            place.instances[place.depth++] = range->first_row;
            id = scene.instances[range->first_row].blas;
        } else if (range->kind == PrimitiveKind::medium) {
            place.index_matched = true;
            id = scene.medium_shapes[range->first_row].boundary;
        } else {
            return place;
        }
    }
}

TriangleVertices triangle_of(const Scene& scene, const Mesh& mesh, std::uint64_t element) {
    if (!mesh.arrays.triangles.empty()) return triangle_vertices(mesh.arrays, element);
    const std::uint32_t place = mesh.places[element];
    return BlockView(&scene.lines[place / kMaxBlock]).triangle(place % kMaxBlock);
}

MaterialId material_of(const Scene& scene, const PrimitiveRange& range, std::uint64_t element) {
    if (range.kind == PrimitiveKind::mesh) {
        const Mesh& mesh = scene.meshes[range.first_row];
        return mesh.materials[mesh.arrays.material_slots.empty() ? 0 : mesh.arrays.material_slots[element]];
    }
    MaterialId material = MaterialId::none;
    primitives::with_row(scene.rows, range.kind, range.first_row + element,
                         [&](const auto& primitive) { material = primitive.material; });
    return material;
}

}  // namespace limn::flat
