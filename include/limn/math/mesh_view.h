/// \file
/// Views of the arrays of a mesh.
#pragma once

#include <cstdint>
#include <span>

#include "limn/math/vec.h"

namespace limn {

/// The arrays of an indexed triangle mesh, which it does not own. Every index is in range.
struct MeshView {
    std::span<const Float3> vertices;               ///< positions in object space
    std::span<const Index3> triangles;              ///< indices into `vertices`
    std::span<const Float3> normals;                ///< one per vertex, or empty
    std::span<const Float2> uvs;                    ///< one per vertex, or empty
    std::span<const std::uint32_t> material_slots;  ///< one per triangle; empty: slot 0 for all
};

}  // namespace limn
