/// \file
/// Scenes ready to be traced.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "limn/core/hash128.h"
#include "limn/core/ray.h"
#include "limn/core/surface.h"
#include "limn/scene/scene.h"

namespace limn {

namespace flat {
struct Scene;
}

/// A hit of a ray in a compiled scene. It holds no pointer.
struct RayHit {
    double t = kInfinity;      ///< in units of the ray's direction; kInfinity: a miss
    std::uint32_t object = 0;  ///< in the order of Scene::add
    /// The primitive's number within the object: the triangle of a mesh, the place in a list.
    std::uint64_t element = 0;
    double u = 0;  ///< triangle: weight of the second vertex; quad: along edge u; foreign: its own; sphere: 0
    double v = 0;  ///< triangle: weight of the third vertex; quad: along edge v; foreign: its own; sphere: 0
    bool index_matched = false;   ///< the boundary of a medium
    std::uint64_t primitive = 0;  ///< the primitive's number within the scene
};

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
    explicit CompiledScene(std::unique_ptr<const flat::Scene> scene);  ///< for `compile`
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
    /// each triangle that the ray meets, once; a sphere where it is entered and where it is left, and once where the
    /// ray touches it. Ties within rounding may stand in either order. Boundaries of media count, flagged; an unusable
    /// ray meets nothing. The first one is closest_hit's.
    ///@{
    std::vector<RayHit> all_hits(const Ray& ray) const;
    void all_hits(const Ray& ray, std::vector<RayHit>& hits) const;  ///< replaces what is in `hits`, keeps its memory
    ///@}

    /// The nearest hits, and any, of many rays, one after the other in the calling thread. A miss has t == kInfinity;
    /// `occluded` is 1 or 0. Returns how many of the rays were unusable.
    /// \throws ArgumentError if the spans differ in length
    ///@{
    std::size_t closest_hit(std::span<const Ray> rays, std::span<RayHit> hits) const;
    std::size_t any_hit(std::span<const Ray> rays, std::span<std::uint8_t> occluded) const;
    ///@}

    /// All about the point that `ray` hits. \pre hit was found by closest_hit for this ray in this scene
    Surface surface_at(const Ray& ray, const RayHit& hit) const;

    const SceneStats& stats() const { return stats_; }  ///< counts and sizes
    /// What is compiled in, separated by spaces: "sphere quad mesh instance motion medium foreign-shape texture ..."
    const std::string& features() const;
    const std::string& name() const;  ///< Scene::name
    /// Of all that its pictures depend on: the same wherever and however it was compiled. User-defined objects are in
    /// it by their tags (core/tagged.h).
    const Hash128& digest() const;
    bool has_untagged() const;  ///< whether it has user-defined objects without a tag

    const flat::Scene& flat() const { return *scene_; }  ///< for limn's own rooms

private:
    std::unique_ptr<const flat::Scene> scene_;
    SceneStats stats_;
};

/// Deprecated, and without effect: all trees are built alike. It leaves with the next version.
enum class BuildQuality : std::uint8_t { medium, high };

/// What `compile` may be told.
struct CompileSettings {
    BuildQuality quality = BuildQuality::medium;  ///< deprecated, without effect
};

/// Compiles a description, in parallel in the caller's TBB arena. Pure: the same scene and settings give the same
/// tables. \throws ArgumentError if an object contains itself, instances nest deeper than 16, the boundary of a medium
/// contains a medium, there are too many primitives, or the background is negative or not finite
CompiledScene compile(const Scene& scene, const CompileSettings& settings = {});

}  // namespace limn
