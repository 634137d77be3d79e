/// \file
/// What queries of a CompiledScene are told, and what they answer. Plain values; none holds a pointer but RayFilter.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "limn/core/math.h"
#include "limn/core/vec.h"

namespace limn {

inline constexpr std::uint64_t kNoPrimitive = ~std::uint64_t{0};  ///< a number that no primitive has

/// A hit of a ray in a compiled scene. It holds no pointer.
struct RayHit {
    double t = kInfinity;      ///< in units of the ray's direction; kInfinity: a miss
    std::uint32_t object = 0;  ///< in the order of Scene::add
    /// The primitive's number within the object: the triangle of a mesh, the place in a list.
    std::uint64_t element = 0;
    /// Triangle: weight of the second vertex; quad: along edge u; disk: over the square around it; user-defined: its
    /// own; sphere: 0.
    double u = 0;
    double v = 0;                 ///< triangle: weight of the third vertex; quad: along edge v; otherwise as u
    bool index_matched = false;   ///< the boundary of a medium
    std::uint64_t primitive = 0;  ///< the primitive's number within the scene
};

/// Where a ray passes through a surface; see CompiledScene::crossings.
struct RayCrossing : RayHit {
    bool inward = false;  ///< against the outward normal
};

/// Where a point lies.
struct PointLocation {
    /// How often the surfaces enclose the point: 0 outside, 1 inside of a closed surface whose normals point outward,
    /// -1 where they point inward; the sum over all surfaces.
    std::int64_t winding_number = 0;
    bool on_surface = false;                 ///< exactly on a sphere or a closed flat primitive; of disks unknown
    std::uint64_t primitive = kNoPrimitive;  ///< the first of those that it is exactly on

    bool is_inside() const { return on_surface || winding_number != 0; }  ///< or on the surface
};

/// The parts of a surface that a point may be nearest to.
enum class Feature : std::uint8_t { face, edge, vertex };

/// The point of all surfaces that is nearest to another.
struct ClosestPoint {
    double distance = kInfinity;             ///< kInfinity: there is none
    Point3 position;                         ///< the nearest point
    Feature feature = Feature::face;         ///< of the primitive, that the point lies on; a disk's rim is its edge
    std::uint32_t object = 0;                ///< as in RayHit
    std::uint64_t element = 0;               ///< as in RayHit
    double u = 0;                            ///< as in RayHit
    double v = 0;                            ///< as in RayHit
    bool index_matched = false;              ///< as in RayHit
    std::uint64_t primitive = kNoPrimitive;  ///< as in RayHit
};

/// Which sides of surfaces count for a ray: front, where it goes against the outward normal, back or both.
/// Where it touches a sphere it meets both.
enum class Faces : std::uint8_t { both, front, back };

/// What a ray passes over. The spans are not owned.
struct RayFilter {
    std::uint64_t without = kNoPrimitive;  ///< a RayHit::primitive: the one that the ray starts on
    Faces faces = Faces::both;             ///< those that count
    /// By RayHit::object, as many as the scene has objects: those of 0 are passed over. Empty: all count.
    std::span<const std::uint8_t> objects = {};
    /// Of batches: `without` for each ray. Empty: the same for all.
    std::span<const std::uint64_t> without_each = {};
};

/// All hits of many rays: those of ray i are hits[first[i]] up to hits[first[i + 1]], not included.
struct RayHits {
    std::vector<RayHit> hits;        ///< in the order of the rays
    std::vector<std::size_t> first;  ///< one more than there are rays

    /// Returns the hits of one ray.
    std::span<const RayHit> of(std::size_t ray) const {
        return std::span(hits).subspan(first[ray], first[ray + 1] - first[ray]);
    }
};

}  // namespace limn
