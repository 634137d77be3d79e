// Filters of rays as the searches take them.
#pragma once

#include <string>

#include "limn/core/error.h"
#include "limn/query/queries.h"
#include "trace/traverse.h"

namespace limn::query {

// \throws ArgumentError if the filter does not fit the scene
inline trace::Filter checked(const flat::Scene& scene, const RayFilter& filter, const char* who) {
    if (!filter.objects.empty() && filter.objects.size() != scene.first_of_object.size())
        throw ArgumentError(std::string(who) + ": filter.objects must be empty or as long as the scene has objects");
    return {scene, filter.without, filter.faces != Faces::back, filter.faces != Faces::front, filter.objects};
}

}  // namespace limn::query
