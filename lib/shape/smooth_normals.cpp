#include "limn/shape/smooth_normals.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "core/elementary.h"
#include "core/nearest_float3.h"
#include "core/require.h"
#include "limn/core/math.h"
#include "predicates/mesh_triangle.h"
#include "shape/arguments.h"
#include "shape/position_numbers.h"

namespace limn {

namespace {

// Corner 3 t + k is vertex k of triangle t.
class Smoother {
public:
    Smoother(const MeshData& data, double crease_degrees)
        : data_(data), cosine_(cosine(radians(crease_degrees))), joined_(3 * data.triangles.size()) {
        std::iota(joined_.begin(), joined_.end(), std::size_t{0});
        measure();
        join_across_edges();
    }

    MeshData smooth() {
        std::vector<Vec3> sums(joined_.size());
        for (std::size_t c = 0; c < joined_.size(); ++c) sums[root(c)] = sums[root(c)] + angle_at(c) * normals_[c / 3];
        MeshData result;
        result.material_slots = data_.material_slots;
        result.faces = data_.faces;
        // Vertices by what they came from and what they are joined to.
        std::unordered_map<std::uint64_t, std::uint32_t> numbers;
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
    struct Side {
        std::uint32_t low, high;      // the ends, by their positions
        std::size_t at_low, at_high;  // corners
    };

    std::uint32_t vertex_of(std::size_t corner) const {
        const Index3& t = data_.triangles[corner / 3];
        return corner % 3 == 0 ? t.a : corner % 3 == 1 ? t.b : t.c;
    }

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

    void join_across_edges() {
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

    // Of those that a corner is joined to, halving the way for the next time.
    std::size_t root(std::size_t corner) {
        while (joined_[corner] != corner) corner = joined_[corner] = joined_[joined_[corner]];
        return corner;
    }

    double angle_at(std::size_t corner) const {
        const TriangleVertices v = corners_of(corner / 3);
        const Point3 p[3] = {v.a, v.b, v.c};
        const std::size_t k = corner % 3;
        const Vec3 one = p[(k + 1) % 3] - p[k], other = p[(k + 2) % 3] - p[k];
        return arc_tangent(length(cross(one, other)), dot(one, other));
    }

    // Where the triangles cancel, that of one of them; without an area, any.
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
    double cosine_;
    std::vector<std::size_t> joined_;  // a corner's way to the one that stands for all that it is joined to
    std::vector<Vec3> normals_;        // of triangles, unit; zero without an area
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
