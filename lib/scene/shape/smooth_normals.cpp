#include "limn/scene/shape/smooth_normals.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "geometry/mesh_triangle.h"
#include "limn/math/math.h"
#include "math/elementary.h"
#include "math/nearest_float3.h"
#include "math/require.h"
#include "scene/shape/arguments.h"
#include "scene/shape/position_numbers.h"

namespace limn {

namespace {

// Computes smooth normals. A corner is a vertex of one triangle: corner 3 t + k is vertex k of triangle t. Corners at
// the same position are joined if their triangles share an edge that isn't a crease. Joined corners get the same
// normal.
class Smoother {
public:
    Smoother(const MeshData& data, double crease_degrees)
        : data_(data), cosine_(cosine(radians(crease_degrees))), joined_(3 * data.triangles.size()) {
        std::iota(joined_.begin(), joined_.end(), std::size_t{0});
        measure();
        join_across_edges();
    }

    // Returns the mesh with smooth normals.
    MeshData smooth() {
        // Add up the normals of joined corners, each weighted by its angle.
        std::vector<Vec3> sums(joined_.size());
        for (std::size_t c = 0; c < joined_.size(); ++c) sums[root(c)] = sums[root(c)] + angle_at(c) * normals_[c / 3];
        // Make a vertex for each pair of an old vertex and a group of joined corners.
        MeshData result;
        result.material_slots = data_.material_slots;
        result.faces = data_.faces;
        std::unordered_map<std::uint64_t, std::uint32_t> numbers;  // the new vertex of each pair
        for (std::size_t c = 0; c < joined_.size(); ++c) {
            const std::uint64_t key = std::uint64_t{vertex_of(c)} * joined_.size() + root(c);
            const auto [place, is_new] = numbers.try_emplace(key, static_cast<std::uint32_t>(result.vertices.size()));
            if (is_new) add_vertex(result, c, sums[root(c)]);
            if (c % 3 == 0) result.triangles.emplace_back();
            Index3& t = result.triangles.back();
            (c % 3 == 0 ? t.a : c % 3 == 1 ? t.b : t.c) = place->second;
        }
        return result;
    }

private:
    // A side of a triangle.
    struct Side {
        std::uint32_t low, high;      // position numbers of its ends, low <= high
        std::size_t at_low, at_high;  // the corners at its ends
    };

    std::uint32_t vertex_of(std::size_t corner) const {
        const Index3& t = data_.triangles[corner / 3];
        return corner % 3 == 0 ? t.a : corner % 3 == 1 ? t.b : t.c;
    }

    // Computes the normals of triangles, and checks their indices.
    void measure() {
        for (std::size_t i = 0; i < data_.triangles.size(); ++i) {
            const Index3& t = data_.triangles[i];
            require(std::max({t.a, t.b, t.c}) < data_.vertices.size(),
                    "smooth_normals: triangle " + std::to_string(i) + " refers to a vertex that is not there");
            const TriangleVertices v = corners_of(i);
            const Vec3 normal = is_degenerate(v) ? Vec3{} : normalize(cross(v.b - v.a, v.c - v.a));
            normals_.push_back(is_finite(normal) ? normal : Vec3{});
        }
    }

    TriangleVertices corners_of(std::size_t i) const {
        return triangle_vertices({data_.vertices, data_.triangles, {}, {}, {}}, i);
    }

    // Joins the corners of each two triangles that share an edge.
    void join_across_edges() {
        // List the sides of triangles, equal ones next to each other.
        const std::vector<std::uint32_t> positions = position_numbers(data_.vertices);
        std::vector<Side> sides;
        for (std::size_t c = 0; c < joined_.size(); ++c) {
            if (normals_[c / 3] == Vec3{}) continue;
            const std::size_t next = c % 3 == 2 ? c - 2 : c + 1;
            const std::uint32_t a = positions[vertex_of(c)], b = positions[vertex_of(next)];
            sides.push_back(a < b ? Side{a, b, c, next} : Side{b, a, next, c});
        }
        const auto ends = [](const Side& s) { return std::pair(s.low, s.high); };
        std::ranges::sort(sides, {}, [&](const Side& s) { return std::tuple(s.low, s.high, s.at_low); });
        // Join across edges with two triangles whose angle is below the crease angle.
        for (auto first = sides.begin(); first != sides.end();) {
            const auto last = std::find_if(first, sides.end(), [&](const Side& s) { return ends(s) != ends(*first); });
            const Side& one = *first;
            const Side& other = *(last - 1);
            if (last - first == 2 && dot(normals_[one.at_low / 3], normals_[other.at_low / 3]) > cosine_) {
                join(one.at_low, other.at_low);
                join(one.at_high, other.at_high);
            }
            first = last;
        }
    }

    void join(std::size_t a, std::size_t b) { joined_[root(a)] = root(b); }

    // Returns the root of the tree of joined corners that has this corner, and halves the path to it (union-find).
    std::size_t root(std::size_t corner) {
        while (joined_[corner] != corner) corner = joined_[corner] = joined_[joined_[corner]];
        return corner;
    }

    // Returns the angle of the triangle at a corner.
    double angle_at(std::size_t corner) const {
        const TriangleVertices v = corners_of(corner / 3);
        const Point3 p[3] = {v.a, v.b, v.c};
        const std::size_t k = corner % 3;
        const Vec3 one = p[(k + 1) % 3] - p[k], other = p[(k + 2) % 3] - p[k];
        return arc_tangent(length(cross(one, other)), dot(one, other));
    }

    // Adds the vertex of a corner. Its normal is the direction of `sum`. If the normals of triangles cancel in the sum,
    // it's the normal of the corner's triangle, or +z if that has no area.
    void add_vertex(MeshData& result, std::size_t corner, const Vec3& sum) const {
        Vec3 normal = normalize(sum);
        if (!is_finite(normal)) normal = normals_[corner / 3];
        if (normal == Vec3{}) normal = {0, 0, 1};
        const std::uint32_t vertex = vertex_of(corner);
        result.vertices.push_back(data_.vertices[vertex]);
        result.normals.push_back(nearest_float3(normal));
        if (!data_.uvs.empty()) result.uvs.push_back(data_.uvs[vertex]);
    }

    const MeshData& data_;
    double cosine_;  // cosine of the crease angle
    std::vector<std::size_t>
        joined_;                 // the parent of each corner in its tree of joined corners; a root is its own parent
    std::vector<Vec3> normals_;  // unit normal of each triangle; zero if it has no area
};

}  // namespace

MeshData smooth_normals(const MeshData& data, double crease_degrees) {
    require_length(data.uvs.size(), data.vertices.size(), "smooth_normals", "uvs");
    require_length(data.material_slots.size(), data.triangles.size(), "smooth_normals", "material_slots");
    require_length(data.faces.size(), data.triangles.size(), "smooth_normals", "faces");
    require(crease_degrees >= 0 && crease_degrees <= 180, "smooth_normals: the angle must be in [0, 180]");
    return Smoother(data, crease_degrees).smooth();
}

}  // namespace limn
