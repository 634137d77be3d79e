/// \file
/// Scenes ready to be traced.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limn/core/hash128.h"
#include "limn/core/ray.h"
#include "limn/core/surface.h"
#include "limn/query/queries.h"
#include "limn/scene/scene.h"

namespace limn {

namespace flat {
struct Scene;
}

/// What compiling made.
struct SceneStats {
    std::size_t memory_bytes = 0;  ///< of the compiled scene, mesh arrays that it shares with the description included
    std::uint64_t primitives = 0;  ///< instanced ones counted once an instance
    std::uint64_t stored_primitives = 0;  ///< instanced ones counted once
    std::uint64_t degenerate = 0;         ///< stored triangles of exactly zero area, which nothing can hit
    std::uint64_t lights = 0;             ///< emitters that can be sampled
    double seconds = 0;                   ///< that compiling took
};

/// A scene in the flat form that limn traces: only what the scene uses. Movable, immutable, thread-safe; the Scene that
/// it was compiled from may be destroyed: what of it is still needed is shared. A moved-from one may only be assigned
/// to or destroyed.
class CompiledScene {
public:
    explicit CompiledScene(std::unique_ptr<flat::Scene> scene);  ///< for `compile`
    /// Moves in constant time.
    ///@{
    CompiledScene(CompiledScene&&) noexcept;
    CompiledScene& operator=(CompiledScene&&) noexcept;
    ///@}
    ~CompiledScene();

    /// The nearest hit with t in (t_min, t_max]; of equally near ones the primitive with the lowest number. Boundaries
    /// of media count, flagged. An unusable ray misses. Throws only what an object of the caller's own class throws.
    std::optional<RayHit> closest_hit(const Ray& ray) const;
    /// Whether there is any hit with t in (t_min, t_max]: exactly where closest_hit finds one.
    bool any_hit(const Ray& ray) const;

    /// Every hit with t in (t_min, t_max], by t and, of equals, by the primitive's number: at a shared edge or vertex
    /// each triangle that the ray meets, once; a sphere where it is entered and where it is left, once where the
    /// ray touches it or both t are rounded to one. Ties within rounding may stand in either order. Boundaries of media
    /// count, flagged; an unusable ray meets nothing. The first one is closest_hit's. The second form replaces what is
    /// in `hits` and keeps its memory, here and below.
    ///@{
    std::vector<RayHit> all_hits(const Ray& ray) const;
    void all_hits(const Ray& ray, std::vector<RayHit>& hits) const;
    ///@}

    /// Where the ray passes through surfaces between t_min and t_max, by t: once also where it goes through an edge or
    /// a vertex. The ray counts as moved by less than any number, both ends with it, always the same way
    /// (docs/queries.md). So a ray that touches a closed surface or runs along a face crosses it twice or not at all:
    /// between two points outside, the count is even. An end that lies on a surface counts as on one side of it. A ray
    /// that touches a sphere between its ends misses it. Disks and user-defined shapes answer as they do for all_hits.
    /// None for an unusable ray.
    ///@{
    std::vector<RayCrossing> crossings(const Ray& ray) const;
    void crossings(const Ray& ray, std::vector<RayCrossing>& crossings) const;
    std::size_t count_intersections(const Ray& ray) const;  ///< how many these are
    /// How many of them go outward less those that go inward: by how much closed surfaces wind more often around the
    /// ray's start than around its end.
    std::int64_t winding_number(const Ray& ray) const;
    ///@}

    /// How often surfaces wind around a point, and whether it lies on one, exactly. `time`: of moving objects, 0 to 1.
    /// What surfaces that are not closed make of a winding number depends on the way that is counted along: see
    /// open_edges. Nowhere, so outside, where a coordinate is not finite.
    PointLocation locate(const Point3& point, double time = 0) const;
    /// Whether the point is inside, or exactly on a surface: PointLocation::is_inside.
    bool contains(const Point3& point, double time = 0) const;
    /// How many edges of triangles, quads and disks are open: used more often one way than the other, ends compared as
    /// they are. 0: every triangle mesh and box is closed, and winding numbers mean what they say. Edges that lie
    /// across several shorter ones count as open, and so do those of surfaces that only instances together close. Takes
    /// some 100 ns and 50 bytes a triangle.
    std::uint64_t open_edges() const;

    /// The nearest point of all surfaces, up to `max_distance` away; of equally near ones the primitive with the lowest
    /// number. The distance is right to 2^-32 of the largest coordinate of the point, the surfaces and, inside
    /// instances, what lies between. Nothing where there is no surface so near, or a coordinate is not finite.
    /// \throws ArgumentError if the scene has user-defined shapes, which only rays can query, or if a sphere or a disk
    /// that may be the nearest stands in an instance that turns its round shape into another
    std::optional<ClosestPoint> closest_point(const Point3& point, double max_distance = kInfinity,
                                              double time = 0) const;
    /// The distance of closest_point; negative where the point is inside (contains), 0 where it is exactly on a
    /// surface, kInfinity where there is no surface. \throws ArgumentError as closest_point
    double signed_distance(const Point3& point, double time = 0) const;

    /// The same for a ray that passes some primitives over. Rays without a filter pay nothing for it.
    /// \throws ArgumentError if `filter.objects` is neither empty nor as long as the scene has objects
    ///@{
    std::optional<RayHit> closest_hit(const Ray& ray, const RayFilter& filter) const;
    bool any_hit(const Ray& ray, const RayFilter& filter) const;
    void all_hits(const Ray& ray, const RayFilter& filter, std::vector<RayHit>& hits) const;
    void crossings(const Ray& ray, const RayFilter& filter, std::vector<RayCrossing>& crossings) const;
    std::size_t count_intersections(const Ray& ray, const RayFilter& filter) const;
    ///@}

    /// Many rays, in the calling thread, or on `threads` of them; 0: on as many as the caller's TBB arena has. The
    /// answers do not depend on it. A miss has t == kInfinity; `occluded` is 1 or 0. Return how many of the rays were
    /// unusable.
    /// \throws ArgumentError if spans differ in length, or threads are not 0 to 1024; as for single rays
    ///@{
    std::size_t closest_hit(std::span<const Ray> rays, std::span<RayHit> hits, int threads = 1) const;
    std::size_t any_hit(std::span<const Ray> rays, std::span<std::uint8_t> occluded, int threads = 1) const;
    std::size_t closest_hit(std::span<const Ray> rays, const RayFilter& filter, std::span<RayHit> hits,
                            int threads = 1) const;
    std::size_t any_hit(std::span<const Ray> rays, const RayFilter& filter, std::span<std::uint8_t> occluded,
                        int threads = 1) const;
    std::size_t all_hits(std::span<const Ray> rays, RayHits& hits, int threads = 1) const;
    std::size_t count_intersections(std::span<const Ray> rays, std::span<std::uint64_t> counts, int threads = 1) const;
    ///@}

    /// The same for many points, at time 0.
    ///@{
    void locate(std::span<const Point3> points, std::span<PointLocation> locations, int threads = 1) const;
    void contains(std::span<const Point3> points, std::span<std::uint8_t> inside, int threads = 1) const;
    void closest_point(std::span<const Point3> points, std::span<ClosestPoint> nearest, int threads = 1) const;
    void signed_distance(std::span<const Point3> points, std::span<double> distances, int threads = 1) const;
    ///@}

    /// All about the point that `ray` hits. \pre hit was found for this ray in this scene, by closest_hit or all_hits;
    /// of a user-defined shape, by closest_hit
    Surface surface_at(const Ray& ray, const RayHit& hit) const;
    /// How much light a surface that is seen straight on scatters, the mean over a few fixed directions: the albedo of
    /// a diffuse material, white for glass, black where there is no material.
    Color albedo(const Surface& surface) const;
    Color emission(const Surface& surface) const;  ///< radiance towards the viewer
    /// What the model calls the material of the surface that is hit (Model::materials), also where another has replaced
    /// it; empty for what is of no model or no material of it. Valid as long as the scene. \pre as for surface_at
    std::string_view material_name(const RayHit& hit) const;

    const SceneStats& stats() const { return stats_; }  ///< counts and sizes
    /// What is compiled in, separated by spaces: "sphere quad mesh instance moving-instance foreign-shape texture ..."
    const std::string& features() const;
    const std::string& name() const;  ///< Scene::name
    /// Of all that its pictures depend on: the same wherever and however it was compiled. User-defined objects are in
    /// it by their tags (core/tagged.h).
    const Hash128& digest() const;
    bool has_untagged() const;  ///< whether it has user-defined objects without a tag

    const flat::Scene& flat() const { return *scene_; }  ///< for limn's own rooms

private:
    friend CompiledScene recompile(CompiledScene&& scene, std::span<const MovedObject> moved);

    std::unique_ptr<flat::Scene> scene_;
    SceneStats stats_;
};

/// Compiles a description, in parallel in the caller's TBB arena. Pure: the same scene gives the same tables.
/// \throws ArgumentError if an object contains itself, instances nest deeper than 16, the boundary of a medium
/// contains a medium, a NormalMap or an AlphaMask stands around another of its kind, there are too many primitives, or
/// the background is negative or not finite
CompiledScene compile(const Scene& scene);

/// Makes of a compiled scene what `compile` makes of its description with some Instances elsewhere. The trees of what
/// is instanced stay; that over the objects, the lights and the media are made anew. So what a program moves often
/// belongs into Instances, and large still meshes too. Renders and queries of the scene must have ended.
/// \throws ArgumentError, and leaves the scene as it is, if there is no such object, it is no Instance or one without
/// primitives, it is moved twice, or its matrices are none for an Instance
CompiledScene recompile(CompiledScene&& scene, std::span<const MovedObject> moved);

}  // namespace limn
