// Numbers of many paths, one after the other: rows that stages read and write.
#pragma once

#include <cstddef>

#include "limn/core/color.h"

namespace limn::sampling {

// As many paths as are shaded together: a multiple of every vector's lanes, few enough for the first cache.
inline constexpr std::size_t kShaded = 32;

using Row = double[kShaded];

struct Rows3 {
    alignas(64) Row x = {};
    Row y = {}, z = {};

    // Of a point, direction or normal.
    template <class Three>
    void set(std::size_t i, const Three& v) {
        x[i] = v.x, y[i] = v.y, z[i] = v.z;
    }
    void set(std::size_t i, const Color& c) { x[i] = c.r, y[i] = c.g, z[i] = c.b; }
    template <class Three>
    Three get(std::size_t i) const {
        return {x[i], y[i], z[i]};
    }
};

}  // namespace limn::sampling
