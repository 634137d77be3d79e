/// \file
/// A mesh's arrays as the tracing code sees them.
#pragma once

#include <cstdint>
#include <span>

#include "limn/core/vec.h"

namespace limn {

/// Views of the arrays of an indexed triangle mesh; not owning. Every index is in range.
struct MeshView {
    std::span<const Float3> vertices;               ///< in object space
    std::span<const Index3> triangles;              ///< rows of `vertices`
    std::span<const Float3> normals;                ///< per vertex, or empty
    std::span<const Float2> uvs;                    ///< per vertex, or empty
    std::span<const std::uint32_t> material_slots;  ///< per triangle, or empty: all slot 0
};

}  // namespace limn
