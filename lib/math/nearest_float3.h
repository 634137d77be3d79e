#pragma once

#include "limn/math/vec.h"

namespace limn {

// Rounds each coordinate to the nearest float.
inline Float3 nearest_float3(const Vec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace limn
