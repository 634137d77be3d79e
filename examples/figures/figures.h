// The eighteen figures of docs/gallery.md. To add one, write figNN_name.cpp with a function of that name, and add a
// line to the list below.
#pragma once

#include "figure.h"
#include "limn/limn.h"

#define LIMN_FIGURES(X)          \
    X(fig01_bouncing_spheres)    \
    X(fig02_from_above)          \
    X(fig03_before_antialiasing) \
    X(fig04_after_antialiasing)  \
    X(fig05_purple_sphere)       \
    X(fig06_earth)               \
    X(fig07_perlin_sphere)       \
    X(fig08_perlin_cube)         \
    X(fig09_checkered_triangle)  \
    X(fig10_specular)            \
    X(fig11_metal)               \
    X(fig12_emissive)            \
    X(fig13_dielectric)          \
    X(fig14_bouncing_ball)       \
    X(fig15_cornell_box)         \
    X(fig16_volume_cornell_box)  \
    X(fig17_without_dof)         \
    X(fig18_with_dof)

namespace limn::figures {

/// The default texture of figure 6, a map of the Earth from Debian's package xplanet-images. The other figures ignore
/// their inputs.
inline const FigureInputs kDefaultInputs{.texture = "/usr/share/xplanet/images/earth.jpg",
                                         .texture_encoding = Encoding::srgb};

#define LIMN_DECLARE_FIGURE(name) Figure name(const FigureInputs& inputs = kDefaultInputs);
LIMN_FIGURES(LIMN_DECLARE_FIGURE)
#undef LIMN_DECLARE_FIGURE

}  // namespace limn::figures
