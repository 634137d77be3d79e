// What is asked and answered: a shape made of float32 numbers, rays of float32 numbers, so that everyone, whatever the
// precision it computes in, gets the same question.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "limn/math/box.h"
#include "limn/math/ray.h"
#include "limn/math/transform.h"
#include "limn/scene/shape/mesh.h"
#include "support/random_geometry.h"

namespace limn::accuracy {

struct Parallelogram {
    Point3 corner;  // corner, its sums with the edges, and both edges: float32 numbers
    Vec3 edge_u, edge_v;
};

// One kind of primitive: a sphere, or triangles, or parallelograms.
struct Geometry {
    Point3 center;
    double radius = 0;  // 0: no sphere
    MeshData mesh;
    std::vector<Parallelogram> quads;
    std::optional<Transform> world_from_object = std::nullopt;
    bool in_fours =
        false;  // the mesh comes from subdivision: triangles 4k to 4k + 3 lie side by side, and so on upward
};

struct Answer {
    double t = kInfinity;  // kInfinity: a miss
    double u = 0, v = 0;
    std::uint32_t primitive = 0;
    bool aborted = false;  // the question killed whoever was asked

    bool hit() const { return t < kInfinity; }
};

inline constexpr std::size_t kBatch = 2048;  // rays that go to one geometry at once

// The nearest float32; beyond its range the largest one.
inline double to_float(double x) {
    constexpr double limit = std::numeric_limits<float>::max();
    return static_cast<double>(static_cast<float>(std::clamp(x, -limit, limit)));
}
template <class Triple>
Triple to_float(const Triple& p) {
    return {to_float(p.x), to_float(p.y), to_float(p.z)};
}
inline Point3 to_point(const Float3& p) { return {p.x, p.y, p.z}; }

// A ray from one point through another, in float32 numbers.
inline Ray ray_through(const Point3& from, const Point3& target) {
    Ray ray;
    ray.origin = to_float(from);
    ray.direction = to_float(target - ray.origin);
    return ray;
}

}  // namespace limn::accuracy
