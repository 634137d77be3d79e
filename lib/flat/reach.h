// Finds the BLASes that contain something, directly or through instances.
#pragma once

#include <vector>

#include "flat/scene.h"

namespace limn::compiler {

// Returns for each BLAS true if it or a BLAS instanced in it, at any depth, has a range for which wanted(range) is
// true.
template <class Wanted>
std::vector<bool> blases_that_reach(const flat::Scene& scene, const Wanted& wanted) {
    // An inner BLAS usually has a larger id than the BLAS that contains it, so go through the ids backwards. A shared
    // BLAS may have a smaller one, so repeat until nothing changes. That takes at most one pass more than BLASes nest.
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
