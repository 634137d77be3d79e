/// \file
/// The roughness of microfacets.
#pragma once

namespace limn {

/// The roughness of a surface of microfacets: u along Surface::dp_du, v perpendicular to it. The square of a roughness
/// is the alpha of the distribution of Trowbridge and Reitz (GGX), as in glTF and in Burley, Physically-Based Shading
/// at Disney, 2012. Mitsuba's roughness is alpha itself. The surface is smooth if both u and v are below 0.001. If only
/// one of them is, it counts as 0.001.
struct Roughness {
    /// The roughness in one direction, in [0, 1]. The materials check the range.
    ///@{
    double u = 0, v = 0;
    ///@}

    constexpr Roughness(double both) : u(both), v(both) {}       ///< isotropic
    constexpr Roughness(double u_, double v_) : u(u_), v(v_) {}  ///< anisotropic, as of brushed metal
};

}  // namespace limn
