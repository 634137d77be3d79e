/// \file
/// A basis around a normal.
#pragma once

#include "limn/math/vec.h"

namespace limn {

/// A right-handed orthonormal basis whose z axis is a given unit normal.
struct Frame {
    Vec3 x;  ///< first tangent
    Vec3 y;  ///< second tangent, cross(z, x)
    Vec3 z;  ///< the normal

    /// Makes the basis around `n` (Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017).
    /// \pre n has unit length
    explicit Frame(const Vec3& n);
    explicit Frame(const Normal3& n) : Frame(Vec3(n)) {}  ///< makes the basis around `n`

    /// Convert a vector from coordinates in this basis to the space in which x, y and z are given, and back.
    ///@{
    Vec3 to_world(const Vec3& local) const { return local.x * x + local.y * y + local.z * z; }
    Vec3 to_local(const Vec3& world) const { return {dot(world, x), dot(world, y), dot(world, z)}; }
    ///@}
};

}  // namespace limn
