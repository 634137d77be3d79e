// Which triangles of a mesh a ray may meet, by bounding spheres far larger than any rounding: a box test that loses
// nothing, so that the textbook kernels show their own faults only, and independent of limn's trees, so that it may
// stand before the exact truth.
#pragma once

#include <vector>

#include "accuracy/question.h"

namespace limn::accuracy {

class NearTriangles {
public:
    NearTriangles() = default;
    // `in_fours`: see Geometry. Meshes that are not are searched whole.
    explicit NearTriangles(const MeshData& mesh, bool in_fours) : count_(mesh.triangles.size()) {
        if (!in_fours) return;
        std::vector<Ball> level;
        for (const Index3& f : mesh.triangles) {
            const Point3 a = to_point(mesh.vertices[f.a]), b = to_point(mesh.vertices[f.b]),
                         c = to_point(mesh.vertices[f.c]);
            const Point3 middle = a + (1.0 / 3) * ((b - a) + (c - a));
            const double radius = std::max({length(a - middle), length(b - middle), length(c - middle)});
            level.push_back({middle, 1.001 * radius + 1e-9 * max_abs(middle)});
        }
        levels_.push_back(level);
        while (levels_.back().size() % 4 == 0 && levels_.back().size() > 4) {
            const std::vector<Ball>& fine = levels_.back();
            std::vector<Ball> coarse;
            for (std::size_t i = 0; i < fine.size(); i += 4) {
                const Point3& p = fine[i].center;
                Ball ball{p + 0.25 * ((fine[i + 1].center - p) + (fine[i + 2].center - p) + (fine[i + 3].center - p)),
                          0};
                for (std::size_t j = i; j < i + 4; ++j)
                    ball.radius = std::max(ball.radius, length(fine[j].center - ball.center) + fine[j].radius);
                coarse.push_back(ball);
            }
            levels_.push_back(std::move(coarse));
        }
    }

    // Adds to what is in `found`.
    void find(const Ray& ray, std::vector<std::uint32_t>& found) const {
        if (levels_.empty()) {
            for (std::size_t i = 0; i < count_; ++i) found.push_back(static_cast<std::uint32_t>(i));
            return;
        }
        const Vec3 along = normalize(ray.direction);
        const double slack = 1e-9 * max_abs(ray.origin);
        for (std::size_t i = 0; i < levels_.back().size(); ++i)
            descend(levels_.size() - 1, i, ray.origin, along, slack, found);
    }

private:
    struct Ball {
        Point3 center;
        double radius;
    };

    void descend(std::size_t level, std::size_t i, const Point3& origin, const Vec3& along, double slack,
                 std::vector<std::uint32_t>& found) const {
        const Ball& ball = levels_[level][i];
        const Vec3 to_center = ball.center - origin;
        const double reach = ball.radius + slack, ahead = dot(to_center, along);
        if (ahead < -reach || length_squared(to_center - ahead * along) > reach * reach) return;
        if (level == 0) return found.push_back(static_cast<std::uint32_t>(i));
        for (std::size_t j = 4 * i; j < 4 * i + 4; ++j) descend(level - 1, j, origin, along, slack, found);
    }

    std::size_t count_ = 0;
    std::vector<std::vector<Ball>> levels_;  // triangles first
};

}  // namespace limn::accuracy
