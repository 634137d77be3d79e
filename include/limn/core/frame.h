/// \file
/// A basis around a normal.
#pragma once

#include "limn/core/vec.h"

namespace limn {

/// A right-handed orthonormal basis; local z is the given unit normal.
struct Frame {
    Vec3 x;  ///< tangent
    Vec3 y;  ///< tangent, z x x
    Vec3 z;  ///< the normal

    /// Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017. \pre n has unit length
    explicit Frame(const Vec3& n);
    explicit Frame(const Normal3& n) : Frame(Vec3(n)) {}  ///< the same

    /// Between this basis and the space that its vectors are given in; lengths stay.
    ///@{
    Vec3 to_world(const Vec3& local) const { return local.x * x + local.y * y + local.z * z; }
    Vec3 to_local(const Vec3& world) const { return {dot(world, x), dot(world, y), dot(world, z)}; }
    ///@}
};

}  // namespace limn
