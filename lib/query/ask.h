// The gates of all queries. A query reaches the tables of its scene through them alone, so that it runs in the
// floating-point environment that limn's proofs assume.
#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "flat/scene.h"
#include "limn/math/error.h"
#include "limn/query/compiled_scene.h"
#include "math/float_environment.h"
#include "trace/traverse.h"

namespace limn::query {

// Returns is_usable(r), faster for most rays: a sum of magnitudes below infinity has only finite terms. The sum may
// also overflow; then is_usable() decides.
inline bool is_fit(const Ray& r) {
    const double across = std::abs(r.direction.x) + std::abs(r.direction.y) + std::abs(r.direction.z);
    const double all = std::abs(r.origin.x) + std::abs(r.origin.y) + std::abs(r.origin.z) + std::abs(r.time) + across;
    return all < kInfinity && across > 0 ? r.t_min <= r.t_max && r.t_min < kInfinity : is_usable(r);
}

// Returns the filter in the form that traversal uses, or std::nullopt if it excludes nothing. RayFilter::without_each
// is ignored. \throws ArgumentError if `filter.objects` is neither empty nor as long as the scene has objects; the
// message begins with `who`
inline std::optional<trace::Filter> checked(const flat::Scene& scene, const RayFilter& filter, const char* who) {
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

// Returns work(tables of the scene, ray, filter in the form of checked()), or a value-initialised result if the ray is
// unusable. \throws ArgumentError as checked() does
template <class Work>
auto ask(const CompiledScene& compiled, const Ray& ray, const RayFilter& filter, const char* who, const Work& work) {
    return ask(compiled, [&](const flat::Scene& scene) {
        const std::optional<trace::Filter> excluded = checked(scene, filter, who);
        using Result = decltype(work(scene, ray, excluded));
        return is_fit(ray) ? work(scene, ray, excluded) : Result{};
    });
}

}  // namespace limn::query
