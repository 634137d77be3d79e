// The truth about a mesh, and meshes that are hard on it.
#pragma once

#include <map>
#include <utility>

#include "hard/hard.h"
#include "hard/shapes.h"

namespace limn::test {

/// The nearest of the exact hits of a mesh's triangles.
class ExactMesh {
public:
    explicit ExactMesh(const MeshData& data) {
        for (const Index3& t : data.triangles)
            corners_.push_back({vertex(data, t.a), vertex(data, t.b), vertex(data, t.c)});
    }

    ExactHit hit_of(std::size_t i, const Ray& ray, Chain chain = {}) const {
        return exact_triangle_hit(corners_[i][0], corners_[i][1], corners_[i][2], ray, chain);
    }
    ExactHit hit(const Ray& ray) const {
        ExactHit nearest;
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            if (passes_by(i, ray)) continue;
            const ExactHit hit = hit_of(i, ray);
            if (hit.hit && (!nearest.hit || hit.t < nearest.t)) nearest = hit;
        }
        return nearest;
    }
    /// Whether a triangle is missed: only far from any doubt, a billionth of all lengths; numbers out of range leave it
    /// to the exact test.
    bool passes_by(std::size_t i, const Ray& ray) const {
        const auto& k = corners_[i];
        const Vec3 d = ray.direction, q = k[0] - ray.origin;
        const double reach = length(k[1] - k[0]) + length(k[2] - k[0]) + 1e-9 * (length(q) + length(k[0] - Point3{}));
        return length_squared(cross(q, d)) > 1.001 * reach * reach * length_squared(d) && reach * length(d) > 1e-100;
    }

    std::size_t size() const { return corners_.size(); }
    std::size_t flat_triangles() const {
        return static_cast<std::size_t>(std::count_if(corners_.begin(), corners_.end(),
                                                      [](const auto& k) { return exactly_flat(k[0], k[1], k[2]); }));
    }

private:
    std::vector<std::array<Point3, 3>> corners_;
};

/// Judges the nearest hit of a mesh that `world` holds, and the element that it names.
inline void judge_mesh(Tally& tally, const BothWorlds& world, const ExactMesh& exact, const Ray& ray) {
    const auto limn = [&](const Ray& r) { return world.hit(r, tally); };
    judge(tally, ray, [&](const Ray& r) { return exact.hit(r); }, limn, {1, -1});
    const std::optional<Answer> answer = limn(ray);
    if (!answer) return;
    const std::string fault = detail::fault_of(exact.hit_of(answer->element, ray), answer, {});
    if (!fault.empty()) tally.fault(ray, "element " + std::to_string(answer->element) + ": " + fault);
}

/// A sphere cut from an icosahedron in `rounds` rounds, each of which halves about half of the edges: triangles of all
/// shapes, closed, without T-junctions; its vertices are moved in and out by up to `bumps` of the radius.
inline MeshData bumpy_sphere(Random& random, int rounds, double bumps, double radius, const Point3& center) {
    const MeshData start = icosphere(0);
    std::vector<Vec3> points;
    for (const Float3& p : start.vertices) points.push_back(normalize(Vec3{p.x, p.y, p.z}));
    std::vector<Index3> faces = start.triangles;
    for (; rounds > 0; --rounds) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::optional<std::uint32_t>> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [place, is_new] = middles.try_emplace(std::minmax(a, b));
            if (is_new && random.chance(0.5)) {
                place->second = static_cast<std::uint32_t>(points.size());
                const double s = random.uniform(0.2, 0.8);
                points.push_back(normalize(s * points[a] + (1 - s) * points[b]));
            }
            return place->second;
        };
        std::vector<Index3> finer;
        for (Index3 f : faces) {
            auto ab = middle(f.a, f.b), bc = middle(f.b, f.c), ca = middle(f.c, f.a);
            const auto turn = [&] {
                f = {f.b, f.c, f.a};
                const auto first = ab;
                ab = bc, bc = ca, ca = first;
            };
            const int cuts = ab.has_value() + bc.has_value() + ca.has_value();
            if (cuts == 0) finer.push_back(f);
            if (cuts == 1) {
                while (!ab) turn();
                finer.insert(finer.end(), {{f.a, *ab, f.c}, {*ab, f.b, f.c}});
            }
            if (cuts == 2) {
                while (ca) turn();
                finer.insert(finer.end(), {{*ab, f.b, *bc}, {f.a, *ab, *bc}, {f.a, *bc, f.c}});
            }
            if (cuts == 3)
                finer.insert(finer.end(), {{f.a, *ab, *ca}, {f.b, *bc, *ab}, {f.c, *ca, *bc}, {*ab, *bc, *ca}});
        }
        faces = std::move(finer);
    }
    MeshData mesh;
    for (const Vec3& p : points)
        mesh.vertices.push_back(to_float3((center - Point3{}) + radius * (1 + bumps * random.uniform(-1, 1)) * p));
    mesh.triangles = std::move(faces);
    return mesh;
}

/// Two cones back to back over a ring of `count` points: fans of `count` triangles at both tips.
inline MeshData double_cone(std::uint32_t count, double radius, const Point3& center) {
    MeshData mesh;
    for (const double z : {radius, -radius}) mesh.vertices.push_back(to_float3((center - Point3{}) + Vec3{0, 0, z}));
    for (std::uint32_t i = 0; i < count; ++i) {
        const double angle = 2 * kPi * i / count;
        const std::uint32_t here = 2 + i, next = 2 + (i + 1) % count;
        mesh.vertices.push_back(to_float3((center - Point3{}) + radius * Vec3{std::cos(angle), std::sin(angle), 0}));
        mesh.triangles.push_back({0, here, next});
        mesh.triangles.push_back({1, next, here});
    }
    return mesh;
}

}  // namespace limn::test
