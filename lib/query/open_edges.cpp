// Implements CompiledScene::open_edges, which counts the edges of surfaces that no other face continues.
#include <algorithm>
#include <bit>
#include <unordered_map>
#include <utility>
#include <vector>

#include "flat/scene.h"
#include "limn/query/compiled_scene.h"
#include "query/ask.h"

namespace limn {

namespace {

struct HashOfPoint {
    std::size_t operator()(const Point3& p) const {
        std::uint64_t hash = 0;
        for (std::size_t a = 0; a < 3; ++a) {
            // Adding 0 turns -0 into +0, which compares equal to it.
            hash = (hash ^ std::bit_cast<std::uint64_t>(p[a] + 0.0)) * 0x9e3779b97f4a7c15u;
            hash ^= hash >> 29;
        }
        return static_cast<std::size_t>(hash);
    }
};

// The directed edges of the faces of one BLAS. Equal points have the same number. An edge is stored as the numbers of
// its two ends, the lower one in the high 32 bits.
class Edges {
public:
    void add_face(std::initializer_list<Point3> corners) {
        const Point3* previous = corners.end() - 1;
        for (const Point3& corner : corners) add(std::exchange(previous, &corner), corner);
    }

    // Returns the number of open edges: uses of an edge in one direction without a use in the opposite direction.
    std::uint64_t open() {
        std::sort(forward_.begin(), forward_.end());
        std::sort(backward_.begin(), backward_.end());
        std::vector<std::uint64_t> rest;
        std::set_symmetric_difference(forward_.begin(), forward_.end(), backward_.begin(), backward_.end(),
                                      std::back_inserter(rest));
        return rest.size();
    }

private:
    void add(const Point3* from, const Point3& to) {
        const std::uint64_t a = number_of(*from), b = number_of(to);
        if (a < b) forward_.push_back(a << 32 | b);
        if (b < a) backward_.push_back(b << 32 | a);
    }
    std::uint64_t number_of(const Point3& p) { return numbers_.try_emplace(p, numbers_.size()).first->second; }

    std::unordered_map<Point3, std::uint64_t, HashOfPoint> numbers_;
    std::vector<std::uint64_t> forward_, backward_;  // uses from the lower number to the higher, and the reverse
};

// Counts the open edges of BLASes. Each BLAS is examined once, however many instances it has.
class OpenEdges {
public:
    explicit OpenEdges(const flat::Scene& scene) : scene_(scene), of_blas_(scene.blases.size(), kUnknown) {}

    // Returns the number of open edges in a BLAS and in all instances and media in it.
    std::uint64_t of(BlasId id) {
        std::uint64_t& known = of_blas_[static_cast<std::size_t>(id)];
        if (known != kUnknown) return known;
        Edges edges;
        std::uint64_t sum = 0;
        for (const PrimitiveRange& range : flat::ranges_of(scene_, flat::blas_at(scene_, id))) {
            if (range.kind == PrimitiveKind::instance) sum += of(scene_.instances[range.first_row].blas);
            if (range.kind == PrimitiveKind::medium) sum += of(scene_.medium_shapes[range.first_row].boundary);
            if (range.kind == PrimitiveKind::disk) sum += range.count;  // the rim of a disk is one open edge
            if (flat::bit(range.kind) & flat::kPlanarKinds) add_faces(range, edges);
        }
        return known = sum + edges.open();
    }

private:
    static constexpr std::uint64_t kUnknown = ~std::uint64_t{0};

    void add_faces(const PrimitiveRange& range, Edges& edges) const {
        for (std::uint64_t i = 0; i < range.count; ++i) {
            if (range.kind == PrimitiveKind::mesh) {
                const flat::Mesh& mesh = scene_.meshes[range.first_row];
                if (!mesh.places.empty() && mesh.places[i] == flat::kNothing) continue;  // a triangle of zero area
            }
            flat::with_primitive(scene_, range, i, [&]<class Kind>(const Kind& face) {
                if constexpr (Kind::kKind == PrimitiveKind::triangle) edges.add_face({face.a, face.b, face.c});
                if constexpr (Kind::kKind == PrimitiveKind::quad)
                    edges.add_face({face.corner, face.corner + face.edge_u, face.corner + (face.edge_u + face.edge_v),
                                    face.corner + face.edge_v});
            });
        }
    }

    const flat::Scene& scene_;
    std::vector<std::uint64_t> of_blas_;  // the results of of(), by BlasId; kUnknown before the first call
};

}  // namespace

std::uint64_t CompiledScene::open_edges() const {
    return query::ask(*this, [](const flat::Scene& scene) { return OpenEdges(scene).of(BlasId::root); });
}

}  // namespace limn
