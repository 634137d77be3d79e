/// \file
/// How rough the microfacets of a surface lie.
#pragma once

namespace limn {

/// The roughness of a surface of microfacets along Surface::dp_du and across it, each in [0, 1]. Its square is the
/// alpha of the distribution of Trowbridge and Reitz (GGX), as in glTF and in Burley, Physically-Based Shading at
/// Disney, 2012; Mitsuba's roughness is alpha. 0 along both is smooth, and so is what is below 0.001.
struct Roughness {
    /// In [0, 1].
    ///@{
    double u = 0, v = 0;
    ///@}

    constexpr Roughness(double both) : u(both), v(both) {}       ///< the same in all directions
    constexpr Roughness(double u_, double v_) : u(u_), v(v_) {}  ///< brushed
};

}  // namespace limn
