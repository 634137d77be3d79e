/// \file
/// Arguments and results of the queries of a CompiledScene. They are plain values; only RayFilter holds pointers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "limn/math/math.h"
#include "limn/math/vec.h"

namespace limn {

inline constexpr std::uint64_t kNoPrimitive = ~std::uint64_t{0};  ///< a number that no primitive has

/// A hit of a ray in a compiled scene.
struct RayHit {
    double t = kInfinity;      ///< in units of the ray's direction; kInfinity for a miss
    std::uint32_t object = 0;  ///< number of the object, in the order of Scene::add
    /// The number of the primitive within the object, for example of the triangle in a mesh or of the shape in a list.
    std::uint64_t element = 0;
    /// Parameters of the point on the primitive.
    ///
    /// - Triangle: barycentric weights of the second and third vertex.
    /// - Quad: coordinates along edge_u and edge_v, 0 to 1.
    /// - Disk: coordinates in the square around it, 0 to 1.
    /// - Sphere: 0. CompiledScene::surface_at computes its texture coordinates.
    /// - User-defined shape: as its `hit` sets them.
    ///@{
    double u = 0;
    double v = 0;
    ///@}
    bool index_matched = false;   ///< true for the boundary of a medium
    std::uint64_t primitive = 0;  ///< number of the primitive within the scene
};

/// A point where a ray passes through a surface; see CompiledScene::crossings.
struct RayCrossing : RayHit {
    bool inward = false;  ///< true if the ray goes against the outward normal
};

/// The location of a point: inside, outside or on surfaces.
struct PointLocation {
    /// The number of times that surfaces wind around the point: 1 for each closed surface around it, or -1 if the
    /// normals of that surface point inward.
    std::int64_t winding_number = 0;
    bool on_surface = false;                 ///< true if the point is exactly on a sphere, triangle or quad
    std::uint64_t primitive = kNoPrimitive;  ///< the lowest number of a primitive that the point is on

    bool is_inside() const { return on_surface || winding_number != 0; }  ///< returns true if inside or on a surface
};

/// A part of a primitive.
enum class Feature : std::uint8_t { face, edge, vertex };

/// The point of all surfaces that is nearest to a given point.
struct ClosestPoint {
    double distance = kInfinity;             ///< distance of the two points; kInfinity if there is none
    Point3 position;                         ///< the nearest point
    Feature feature = Feature::face;         ///< part of the primitive that has the point; the rim of a disk is an edge
    std::uint32_t object = 0;                ///< as in RayHit
    std::uint64_t element = 0;               ///< as in RayHit
    double u = 0;                            ///< as in RayHit
    double v = 0;                            ///< as in RayHit
    bool index_matched = false;              ///< as in RayHit
    std::uint64_t primitive = kNoPrimitive;  ///< as in RayHit
};

/// The sides of surfaces that a ray can hit. A ray hits the front if it goes against the outward normal, else the back.
/// A ray that touches a sphere hits both sides.
enum class Faces : std::uint8_t { both, front, back };

/// The primitives that a ray ignores. It does not own the arrays of its spans.
struct RayFilter {
    std::uint64_t without = kNoPrimitive;  ///< RayHit::primitive to ignore, for example the one that the ray starts on
    Faces faces = Faces::both;             ///< the sides that can be hit
    /// One value for each object of the scene, by RayHit::object. An object whose value is 0 is ignored. If the span is
    /// empty, no object is ignored.
    std::span<const std::uint8_t> objects = {};
    /// A value for each ray of a batch, which is used in place of `without`. If the span is empty, `without` is used
    /// for all rays. Queries of a single ray ignore the span.
    std::span<const std::uint64_t> without_each = {};

    /// Returns true if no primitive is ignored.
    constexpr bool is_empty() const {
        return without == kNoPrimitive && faces == Faces::both && objects.empty() && without_each.empty();
    }
};

inline constexpr RayFilter kNoFilter;  ///< the filter that ignores no primitive

/// All hits of many rays. The hits of ray i have the indices from first[i] up to, but not including, first[i + 1].
struct RayHits {
    std::vector<RayHit> hits;        ///< the hits of all rays, in the order of the rays
    std::vector<std::size_t> first;  ///< index of the first hit of each ray, then hits.size()

    /// Returns the hits of one ray.
    std::span<const RayHit> of(std::size_t ray) const {
        return std::span(hits).subspan(first[ray], first[ray + 1] - first[ray]);
    }
};

}  // namespace limn
