/// \file
/// Compiled scenes, and the queries that they answer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limn/math/hash128.h"
#include "limn/math/ray.h"
#include "limn/math/surface.h"
#include "limn/query/queries.h"
#include "limn/scene/scene.h"

namespace limn {

namespace flat {
struct Scene;
}

/// The size of a compiled scene and the time that compiling took.
struct SceneStats {
    std::size_t memory_bytes = 0;         ///< memory of the scene, with the mesh arrays that it shares with the Scene
    std::uint64_t primitives = 0;         ///< number of primitives; an instanced one counts for each instance
    std::uint64_t stored_primitives = 0;  ///< the same without degenerate ones; an instanced one counts once
    std::uint64_t degenerate = 0;  ///< number of triangles of exactly zero area, which no ray can hit; counted likewise
    std::uint64_t lights = 0;      ///< number of light sources that can be sampled
    double seconds = 0;            ///< time that compiling took
};

/// A scene in the flat form that limn traces rays against. `compile` makes it from a Scene.
///
/// It is immutable, and any number of threads may query it at the same time. It shares ownership of the arrays and
/// objects of the Scene that it needs. The Scene may be destroyed. A moved-from CompiledScene may only be assigned to
/// or destroyed.
///
/// Queries decide exactly what is hit, crossed or inside. docs/queries.md explains their rules, with examples. They
/// throw what the functions of user-defined objects throw, and ArgumentError as said below.
class CompiledScene {
public:
    explicit CompiledScene(std::unique_ptr<flat::Scene> scene);  ///< internal; called by `compile`
    /// Move a scene, in constant time.
    ///@{
    CompiledScene(CompiledScene&&) noexcept;
    CompiledScene& operator=(CompiledScene&&) noexcept;
    ///@}
    ~CompiledScene();

    /// Returns the nearest hit with t in (t_min, t_max]. If several are equally near, the one on the primitive with the
    /// lowest number is returned. The boundary of a medium is a hit too; RayHit::index_matched marks it. An unusable
    /// ray (see is_usable) misses.
    /// \param filter the primitives that the ray ignores. Queries with a filter are somewhat slower.
    /// \throws ArgumentError if `filter.objects` is not empty and does not have one value for each object of the scene
    std::optional<RayHit> closest_hit(const Ray& ray, const RayFilter& filter = kNoFilter) const;
    /// Returns true if closest_hit finds a hit for the ray. Throws ArgumentError as closest_hit does.
    bool any_hit(const Ray& ray, const RayFilter& filter = kNoFilter) const;

    /// Returns every hit with t in (t_min, t_max], sorted by t. Hits with the same t are sorted by the number of the
    /// primitive. The first hit is that of closest_hit. Throws as closest_hit does.
    ///
    /// - At a shared edge or vertex each triangle that the ray hits is listed once.
    /// - A sphere is hit where the ray enters and where it exits. It is listed once if the ray touches it, or if both t
    ///   are rounded to the same number.
    /// - The t of hits at the same point may differ by rounding. Such hits may be in either order.
    /// - The boundary of a medium is a hit too; RayHit::index_matched marks it.
    /// - An unusable ray has no hits.
    std::vector<RayHit> all_hits(const Ray& ray, const RayFilter& filter = kNoFilter) const;

    /// Returns the points where the ray passes through surfaces between t_min and t_max, sorted by t. A passage through
    /// an edge or a vertex is listed once. The ray and both of its ends count as moved by an infinitesimal vector, the
    /// same for all rays (docs/queries.md). Throws as closest_hit does.
    ///
    /// - The number of crossings with a closed surface is even between two points outside.
    /// - A ray that touches an edge of a closed surface has two crossings there or none. The same holds for a ray that
    ///   runs along a face and is outside before and after it.
    /// - An end exactly on a surface is on the side to which it is moved.
    /// - A ray that touches a sphere between its ends does not cross it.
    /// - Disks and user-defined shapes are crossed where all_hits has hits.
    /// - An unusable ray has no crossings.
    std::vector<RayCrossing> crossings(const Ray& ray, const RayFilter& filter = kNoFilter) const;
    /// Returns the number of crossings.
    std::size_t count_intersections(const Ray& ray, const RayFilter& filter = kNoFilter) const;
    /// Returns the number of outward crossings minus the number of inward ones. If surfaces are closed, this is the
    /// winding number around the start of the ray minus that around its end.
    std::int64_t winding_number(const Ray& ray, const RayFilter& filter = kNoFilter) const;

    /// Returns the winding number of the surfaces around a point, and whether the point is exactly on a surface. If a
    /// surface is not closed (see open_edges), the winding number depends on the ray along which it is counted, which
    /// is unspecified. If a coordinate or the time isn't finite, the point counts as outside.
    /// \param point in world space
    /// \param time the time, see Ray::time
    PointLocation locate(const Point3& point, double time = 0) const;
    /// Returns PointLocation::is_inside of `locate`: true if the point is inside or exactly on a surface.
    bool contains(const Point3& point, double time = 0) const;
    /// Returns the number of open edges of triangles, quads and disks. An edge is open if faces use it more often in
    /// one direction than in the other. It counts once for each use in excess. The ends of edges are compared by their
    /// coordinates. If the number is 0, all meshes and boxes are closed, and winding numbers are meaningful.
    ///
    /// - An edge that coincides with several shorter ones is open.
    /// - If a surface is closed only by several instances taken together, the edges at which they meet count as open.
    /// - The rim of a disk is an open edge.
    ///
    /// The function takes about 100 ns and 50 bytes for each triangle.
    std::uint64_t open_edges() const;

    /// Returns the point of all surfaces that is nearest to `point`. If several are equally near, the one on the
    /// primitive with the lowest number is returned. Let M be the largest magnitude of a coordinate of the point, of
    /// the surfaces in world space, and of the intermediate results of the transforms of instances. The distance is off
    /// by at most 2^-32 M. Returns std::nullopt if no surface is within `max_distance`, or if a coordinate or the time
    /// is not finite. \throws ArgumentError if the scene has user-defined shapes, which only rays can query, or if a
    /// sphere or disk that may be the nearest is in an instance that shears it or scales it unevenly
    std::optional<ClosestPoint> closest_point(const Point3& point, double max_distance = kInfinity,
                                              double time = 0) const;
    /// Returns the distance of closest_point. It is negative if the point is inside, 0 if the point is exactly on a
    /// surface, and kInfinity if there is no surface, or if a coordinate or the time is not finite.
    /// \throws ArgumentError as closest_point does
    double signed_distance(const Point3& point, double time = 0) const;

    /// Answer the queries of the same names for many rays, bit for bit as for single rays. Result i is that of rays[i].
    /// A miss of closest_hit has t == kInfinity. `occluded` is 1 if the ray hits something, else 0. An unusable ray
    /// misses.
    /// \param threads the number of threads: 1 is the calling thread, 0 as many as the caller's TBB arena has. The
    /// results do not depend on it.
    /// \return the number of unusable rays
    /// \throws ArgumentError if
    /// - spans differ in length,
    /// - `threads` is not in 0 to 1024,
    /// - `filter.objects` is not empty and does not have one value for each object of the scene,
    /// - `filter.without_each` is not empty and does not have one value for each ray.
    ///@{
    std::size_t closest_hit(std::span<const Ray> rays, std::span<RayHit> hits, int threads = 1,
                            const RayFilter& filter = kNoFilter) const;
    std::size_t any_hit(std::span<const Ray> rays, std::span<std::uint8_t> occluded, int threads = 1,
                        const RayFilter& filter = kNoFilter) const;
    std::size_t all_hits(std::span<const Ray> rays, RayHits& hits, int threads = 1,
                         const RayFilter& filter = kNoFilter) const;
    std::size_t count_intersections(std::span<const Ray> rays, std::span<std::uint64_t> counts, int threads = 1,
                                    const RayFilter& filter = kNoFilter) const;
    ///@}

    /// Answer the queries of the same names for many points at time 0. Result i is that of points[i]. `inside` is 1 or
    /// 0. A ClosestPoint has the distance kInfinity if there is no surface. `threads` is as for rays.
    /// \throws ArgumentError if spans differ in length or `threads` is not in 0 to 1024, and as for single points
    ///@{
    void locate(std::span<const Point3> points, std::span<PointLocation> locations, int threads = 1) const;
    void contains(std::span<const Point3> points, std::span<std::uint8_t> inside, int threads = 1) const;
    void closest_point(std::span<const Point3> points, std::span<ClosestPoint> nearest, int threads = 1) const;
    void signed_distance(std::span<const Point3> points, std::span<double> distances, int threads = 1) const;
    ///@}

    /// Returns the surface at the point that `ray` hits.
    /// \pre `hit` was found in this scene for `ray`, by closest_hit or all_hits; for a user-defined shape only by
    /// closest_hit
    Surface surface_at(const Ray& ray, const RayHit& hit) const;
    /// Returns the albedo: the share of the light arriving along the shading normal that is scattered. It is the mean
    /// weight of 16 fixed samples of the material. It is exact for a diffuse material, white for a Dielectric, and
    /// black if there is no material.
    Color albedo(const Surface& surface) const;
    Color emission(const Surface& surface) const;  ///< returns the radiance that is emitted towards the viewer
    /// Returns the name that the model file gives to the material of the surface (Model::materials), even if
    /// Model::replace_material has replaced the material. The name is empty if the object is not from a model, or the
    /// face has no material in the file. The view is valid while the scene exists.
    /// \pre `hit` was found in this scene
    std::string_view material_name(const RayHit& hit) const;

    const SceneStats& stats() const { return stats_; }  ///< returns size and compile time
    /// Returns the kinds of shapes and the features that the scene uses, separated by blanks: "sphere quad mesh
    /// instance moving-instance foreign-shape texture ..."
    const std::string& features() const;
    const std::string& name() const;  ///< returns Scene::name
    /// Returns the digest of everything in the scene that its pictures depend on. It does not depend on the machine or
    /// the build that compiled the scene. User-defined objects enter it by their tags (limn/math/tagged.h).
    const Hash128& digest() const;
    bool has_untagged() const;  ///< returns true if a user-defined object has no tag

    const flat::Scene& flat() const { return *scene_; }  ///< internal; returns the tables

private:
    friend CompiledScene recompile(CompiledScene&& scene, std::span<const MovedObject> moved);

    std::unique_ptr<flat::Scene> scene_;
    SceneStats stats_;
};

/// Compiles a scene, in parallel in the caller's TBB arena. Pure: the same scene always gives the same tables.
/// \throws ArgumentError if
/// - an object contains itself,
/// - instances are nested deeper than 16,
/// - the boundary of a medium contains a medium,
/// - a NormalMap contains a NormalMap, or an AlphaMask an AlphaMask,
/// - there are too many objects or primitives,
/// - the background is negative or not finite.
CompiledScene compile(const Scene& scene);

/// Returns the scene that `compile` would make from the Scene with some Instances at other places. The trees of
/// instanced objects are kept. Three things are built again: the tree over all objects, the table of lights, and the
/// list of media. `recompile` is therefore fast if moving objects and large static meshes are Instances.
/// \pre no render or query of `scene` is running
/// \throws ArgumentError if an object does not exist, isn't an Instance, is an Instance without primitives or is moved
/// twice, or if its matrices are invalid for an Instance; `scene` is then unchanged
CompiledScene recompile(CompiledScene&& scene, std::span<const MovedObject> moved);

}  // namespace limn
