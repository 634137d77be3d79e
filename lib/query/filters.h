// Converts the filters of the public interface into those of the traversal.
#pragma once

#include <string>

#include "limn/math/error.h"
#include "limn/query/queries.h"
#include "trace/traverse.h"

namespace limn::query {

// Returns the filter of one ray in the form that traversal uses. RayFilter::without_each is ignored.
// \throws ArgumentError if `filter.objects` is neither empty nor as long as the scene has objects; the message begins
// with `who`
inline trace::Filter checked(const flat::Scene& scene, const RayFilter& filter, const char* who) {
    if (!filter.objects.empty() && filter.objects.size() != scene.first_of_object.size())
        throw ArgumentError(std::string(who) + ": filter.objects must be empty or as long as the scene has objects");
    return {scene, filter.without, filter.faces != Faces::back, filter.faces != Faces::front, filter.objects};
}

}  // namespace limn::query
