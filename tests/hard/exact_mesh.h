// The truth about a mesh.
#pragma once

#include "hard/hard.h"
#include "hard/shapes.h"
#include "support/closed_meshes.h"

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

}  // namespace limn::test
