// Rays against the compiled scene, exactly: whatever the SIMD kernels find or leave undecided is decided by the
// definitions that the described shapes use too, lib/geometry.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "flat/scene.h"
#include "limn/math/ray.h"

namespace limn::trace {

struct Hit : flat::RawHit {
    double u = 0, v = 0;         // of triangles, quads and disks, and as user-defined shapes say
    bool index_matched = false;  // as user-defined shapes say
};

// The nearest surface with t in (t_min, t_max]; of equally near ones the lowest number. Media are apart. \pre
// is_usable(ray)
Hit closest_hit(const flat::Scene& scene, const Ray& ray);
bool any_hit(const flat::Scene& scene, const Ray& ray);

// The same for each of up to kMostRays rays: those that follow each other and go much the same way are traced together.
inline constexpr std::size_t kMostRays = 256;  // so that what is kept for each stays in the cache
void closest_hits(const flat::Scene& scene, std::span<const Ray> rays, Hit* hits);
void any_hits(const flat::Scene& scene, std::span<const Ray> rays, std::uint8_t* found);
// Whether something stops light on the way: user-defined shapes that say their boundary is index-matched do not.
void are_occluded(const flat::Scene& scene, std::span<const Ray> rays, std::uint8_t* found);

// The same for the boundary of a medium.
Hit closest_boundary(const flat::Scene& scene, const flat::Medium& medium, const Ray& ray);

// Where a ray meets a surface.
struct Crossing {
    double t;
    bool inward;                 // against the outward normal
    bool index_matched = false;  // as user-defined shapes say
    std::uint64_t primitive = 0;
    double u = 0, v = 0;
};

// The media, by their rows in the scene, whose bounds a ray may meet up to t_max, replacing what is in `media`.
void media_met(const flat::Scene& scene, const Ray& ray, std::vector<std::uint32_t>& media);

// What the moved ray (geometry/passage.h) passes through of the boundary of a medium, in no particular order,
// replacing what is in `out`.
void crossings(const flat::Scene& scene, const flat::Medium& medium, const Ray& ray, std::vector<Crossing>& out);

// What a ray passes over.
struct Filter {
    const flat::Scene& scene;
    std::uint64_t without;
    bool front, back;                       // which sides count
    std::span<const std::uint8_t> objects;  // those of 0 do not; empty: all do

    bool accepts(std::uint64_t number) const {
        return number != without && (objects.empty() || objects[flat::object_of(scene, number)] != 0);
    }
    bool accepts(std::uint64_t number, bool inward) const { return (inward ? front : back) && accepts(number); }
};

// closest_hit and any_hit with a filter, of boundaries of media too.
Hit closest_hit(const flat::Scene& scene, const Ray& ray, const Filter& filter);
bool any_hit(const flat::Scene& scene, const Ray& ray, const Filter& filter);

// Appends every hit with t in (t_min, t_max] to `out`, in no particular order. The boundaries of media are hit too, and
// flagged. \pre is_usable(ray)
void every_hit(const flat::Scene& scene, const Ray& ray, std::vector<Crossing>& out,
               const std::optional<Filter>& filter = {});

// What the moved ray (geometry/passage.h) passes through, boundaries of media too.
struct PassageCount {
    std::uint64_t count = 0;
    std::int64_t outward = 0;                     // of which go outward, less those that go inward
    std::uint64_t touched = flat::RawHit::kMiss;  // the lowest number of what the origin lies on, where that was wanted
};
// Counts the crossings, and appends them to `out` if that is not null, in no particular order. \pre is_usable(ray)
PassageCount passages(const flat::Scene& scene, const Ray& ray, bool wants_touched, std::vector<Crossing>* out,
                      const std::optional<Filter>& filter = {});

// visit(frame) with the ray as an instance's BLAS sees it, and the result of that.
template <class Visit>
auto inside(const flat::Instance& instance, const RayFrame& outside, const Visit& visit) {
    if (!instance.moving)
        return visit(RayFrame(outside, instance.world_from_object0, instance.object_from_world,
                              instance.object_from_world_error));
    const Transform m = interpolate(instance.world_from_object0, instance.world_from_object1, outside.ray.time);
    return visit(RayFrame(outside, m));
}

}  // namespace limn::trace
