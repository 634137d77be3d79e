// The gates of all queries. A query reaches the tables of its scene through them alone, so that it runs in the
// floating-point environment that limn's proofs assume.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "flat/scene.h"
#include "limn/math/error.h"
#include "limn/query/compiled_scene.h"
#include "math/float_environment.h"
#include "trace/traverse.h"

namespace limn::query {

// Returns is_usable(r). It isn't inlined, because that would make is_fit() slower.
[[gnu::noinline]] inline bool is_usable_out_of_line(const Ray& r) { return is_usable(r); }

// Returns is_usable(r), faster for most rays. A sum that is finite has only finite terms. The sum may also overflow;
// then is_usable() decides.
inline bool is_fit(const Ray& r) {
    const Point3& o = r.origin;
    const Vec3& d = r.direction;
    const double sum = ((o.x + o.y) + (o.z + r.time)) + ((d.x + d.y) + d.z);
    if (!(std::abs(sum) < kInfinity)) return is_usable_out_of_line(r);
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x) << 1; };  // 0 for 0 and -0
    return (bits(d.x) | bits(d.y) | bits(d.z)) != 0 && r.t_min <= r.t_max && r.t_min < kInfinity;
}

// Returns true if the ray is unusable and the search doesn't find that out. The search of a scene that is a tree alone
// does: most rays are then checked only once.
inline bool is_refused(const flat::Scene& scene, const Ray& ray) {
    return (!scene.list.empty() || !scene.media.empty()) && !is_fit(ray);
}

// A filter in the form that traversal uses. It is std::nullopt if nothing is excluded.
using Excluded = std::optional<trace::Filter>;

// Converts a filter. RayFilter::without_each is ignored.
// \throws ArgumentError if `filter.objects` is neither empty nor as long as the scene has objects; the message begins
// with `who`
inline Excluded checked(const flat::Scene& scene, const RayFilter& filter, const char* who) {
    if (filter.is_empty()) return std::nullopt;
    if (!filter.objects.empty() && filter.objects.size() != scene.first_of_object.size())
        throw ArgumentError(std::string(who) + ": filter.objects must be empty or as long as the scene has objects");
    return trace::Filter{scene, filter.without, filter.faces != Faces::back, filter.faces != Faces::front,
                         filter.objects};
}

// Returns work(tables of the scene).
template <class Work>
auto ask(const CompiledScene& compiled, const Work& work) {
    const FloatEnvironment environment;
    return work(compiled.flat());
}

// Returns work(scene, ray, filter in the form of checked()), or a value-initialised result if the ray is unusable.
// \throws ArgumentError as checked() does
template <class Work>
[[gnu::noinline]] auto answer_filtered(const flat::Scene& scene, const Ray& ray, const RayFilter& filter,
                                       const char* who, const Work& work) {
    const Excluded excluded = checked(scene, filter, who);
    return is_fit(ray) ? work(scene, ray, excluded) : decltype(work(scene, ray, excluded)){};
}

// Returns the same for the tables of a compiled scene. A query without a filter pays only for the comparison of two
// addresses.
template <class Work>
auto ask(const CompiledScene& compiled, const Ray& ray, const RayFilter& filter, const char* who, const Work& work) {
    return ask(compiled, [&](const flat::Scene& scene) {
        if (&filter != &kNoFilter) [[unlikely]]
            return answer_filtered(scene, ray, filter, who, work);
        return is_refused(scene, ray) ? decltype(work(scene, ray, Excluded())){} : work(scene, ray, Excluded());
    });
}

}  // namespace limn::query
