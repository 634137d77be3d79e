// Searches of the compiled scene with rays. The results are exact: lib/geometry decides what vector code leaves
// undecided, with the same functions as for described shapes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "flat/scene.h"
#include "limn/math/ray.h"

namespace limn::trace {

struct Hit : flat::RawHit {
    double u = 0, v = 0;         // set for triangles, quads, disks and user-defined shapes
    bool index_matched = false;  // true if a user-defined shape says so
};

// Return the nearest hit with t in (t_min, t_max], and whether there is any hit. Of equally near hits, the primitive
// with the lowest number is returned. Boundaries of media don't count. An unusable ray misses. \pre the scene has no
// list or is_usable(ray)
Hit closest_hit(const flat::Scene& scene, const Ray& ray);
bool any_hit(const flat::Scene& scene, const Ray& ray);

// The same for each of up to kMostRays rays.
inline constexpr std::size_t kMostRays = 512;  // few enough that their data stays in the cache
void closest_hits(const flat::Scene& scene, std::span<const Ray> rays, Hit* hits);
void any_hits(const flat::Scene& scene, std::span<const Ray> rays, std::uint8_t* found);
// Tells for each ray whether something stops its light. Index-matched boundaries of user-defined shapes don't.
void are_occluded(const flat::Scene& scene, std::span<const Ray> rays, std::uint8_t* found);

// Room for an object for each of these rays. The objects aren't initialised: that would take longer than a small batch.
template <class T>
union RoomForRays {
    std::array<T, kMostRays> of;
    RoomForRays() {}
};

// Returns the nearest hit of the boundary of a medium.
Hit closest_boundary(const flat::Scene& scene, const flat::Medium& medium, const Ray& ray);

// A hit or a passage of a ray.
struct Crossing {
    double t;
    bool inward;                 // true if the ray goes against the outward normal
    bool index_matched = false;  // true for boundaries of media, and if a user-defined shape says so
    std::uint64_t primitive = 0;
    double u = 0, v = 0;
};

// Sets `media` to the rows of the media whose bounds the ray may meet up to t_max.
void media_met(const flat::Scene& scene, const Ray& ray, std::vector<std::uint32_t>& media);

// Sets `out` to the passages of the moved ray (geometry/passage.h) through the boundary of a medium, in no particular
// order.
void crossings(const flat::Scene& scene, const flat::Medium& medium, const Ray& ray, std::vector<Crossing>& out);

// The primitives and sides that a query ignores.
struct Filter {
    const flat::Scene& scene;
    std::uint64_t without;
    bool front, back;                       // true if hits of that side count
    std::span<const std::uint8_t> objects;  // objects with 0 don't count; if empty, all count

    bool accepts(std::uint64_t number) const {
        return number != without && (objects.empty() || objects[flat::object_of(scene, number)] != 0);
    }
    bool accepts(std::uint64_t number, bool inward) const { return (inward ? front : back) && accepts(number); }
};

// The same with a filter. Boundaries of media count here.
Hit closest_hit(const flat::Scene& scene, const Ray& ray, const Filter& filter);
bool any_hit(const flat::Scene& scene, const Ray& ray, const Filter& filter);

// Appends every hit with t in (t_min, t_max] to `out`, in no particular order. The boundaries of media are hit too, and
// flagged. \pre is_usable(ray)
void every_hit(const flat::Scene& scene, const Ray& ray, std::vector<Crossing>& out,
               const std::optional<Filter>& filter = {});

// The number of passages of the moved ray (geometry/passage.h). Boundaries of media count.
struct PassageCount {
    std::uint64_t count = 0;
    std::int64_t outward = 0;                     // the number that goes outward, less that which goes inward
    std::uint64_t touched = flat::RawHit::kMiss;  // if wanted, the lowest number of a primitive that the origin is on
};
// Counts the crossings, and appends them to `out` if that is not null, in no particular order. \pre is_usable(ray)
PassageCount passages(const flat::Scene& scene, const Ray& ray, bool wants_touched, std::vector<Crossing>* out,
                      const std::optional<Filter>& filter = {});

// Calls visit() with the frame of the ray inside an instance, and returns the result.
template <class Visit>
auto inside(const flat::Instance& instance, const RayFrame& outside, const Visit& visit) {
    if (!instance.moving)
        return visit(RayFrame(outside, instance.world_from_object0, instance.object_from_world,
                              instance.object_from_world_error));
    const Transform m = interpolate(instance.world_from_object0, instance.world_from_object1, outside.ray.time);
    return visit(RayFrame(outside, m));
}

}  // namespace limn::trace
