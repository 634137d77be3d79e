#pragma once

#include <vector>

#include "flat/scene.h"

namespace limn::compiler {

// For each group, whether a range that satisfies `wanted` is in it or in a group instanced in it.
template <class Wanted>
std::vector<bool> groups_that_reach(const flat::Scene& scene, const Wanted& wanted) {
    // Inner groups get their ids after the ones that open them, but a shared one may be older than its user: repeat
    // until nothing changes, at most as often as groups nest.
    std::vector<bool> reaches(scene.groups.size(), false);
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t g = scene.groups.size(); g-- > 0;) {
            for (const PrimitiveRange& range : flat::ranges_of(scene, scene.groups[g])) {
                if (reaches[g]) break;
                const bool found = range.kind == PrimitiveKind::instance
                                       ? reaches[static_cast<std::size_t>(scene.instances[range.first_row].group)]
                                       : wanted(range);
                if (found) reaches[g] = changed = true;
            }
        }
    }
    return reaches;
}

}  // namespace limn::compiler
