// What this build of the library can trace: everything, unless it was configured with LIMN_WITHOUT. That option has one
// purpose: to measure what the code for a feature costs scenes that do not use it (./build.sh bench).
#pragma once

#include <string_view>

#include "limn/records.h"

#ifndef LIMN_WITHOUT
#define LIMN_WITHOUT ""
#endif

namespace limn::flat {

constexpr bool is_built(std::string_view feature) {
    return std::string_view(LIMN_WITHOUT).find(feature) == std::string_view::npos;
}

inline constexpr bool kHasMotion = is_built("motion");
inline constexpr bool kHasMedia = is_built("media");
inline constexpr bool kHasInstances = is_built("instances");
inline constexpr bool kHasForeignShapes = is_built("foreign");
inline constexpr bool kHasTextures = is_built("textures");
inline constexpr bool kHasSmoothNormals = is_built("normals");

constexpr unsigned bit(PrimitiveKind kind) { return 1u << static_cast<unsigned>(kind); }

inline constexpr unsigned kPlanarKinds =
    bit(PrimitiveKind::triangle) | bit(PrimitiveKind::quad) | bit(PrimitiveKind::mesh);

// The kinds of primitives that there may be in a tree.
inline constexpr unsigned kBuiltKinds =
    ~((kHasMotion ? 0 : bit(PrimitiveKind::moving_sphere)) | (kHasInstances ? 0 : bit(PrimitiveKind::instance)) |
      (kHasForeignShapes ? 0 : bit(PrimitiveKind::foreign)));

}  // namespace limn::flat
