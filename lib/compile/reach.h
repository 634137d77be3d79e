#pragma once

#include <vector>

#include "flat/scene.h"

namespace limn::compiler {

// For each BLAS, whether a range that satisfies `wanted` is in it or in a BLAS instanced in it.
template <class Wanted>
std::vector<bool> blases_that_reach(const flat::Scene& scene, const Wanted& wanted) {
    // Inner BLASes get their ids after the ones that open them, but a shared one may be older than its user: repeat
    // until nothing changes, at most as often as BLASes nest.
    std::vector<bool> reaches(scene.blases.size(), false);
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t g = scene.blases.size(); g-- > 0;) {
            for (const PrimitiveRange& range : flat::ranges_of(scene, scene.blases[g])) {
                if (reaches[g]) break;
                const bool found = range.kind == PrimitiveKind::instance
                                       ? reaches[static_cast<std::size_t>(scene.instances[range.first_row].blas)]
                                       : wanted(range);
                if (found) reaches[g] = changed = true;
            }
        }
    }
    return reaches;
}

}  // namespace limn::compiler
