/// \file
/// Daylight for those who have no map of it.
#pragma once

#include <memory>

#include "limn/core/color.h"
#include "limn/core/vec.h"
#include "limn/scene/environment.h"
#include "limn/scene/lights.h"

namespace limn {

/// What daylight depends on.
struct SkySettings {
    Vec3 to_sun{0.4, 0.7, 0.6};      ///< towards the Sun, of any length; above the horizon: y > 0
    double turbidity = 3;            ///< how hazy the air is: 2 (clear) to 10 (haze)
    Color ground{0.25, 0.25, 0.25};  ///< albedo of what is below the horizon, in [0, 1]
    /// Of the radiance. At 1 a luminance of 683 cd / m^2 is radiance 1, and the noon's Sun gives 150 W / m^2; with the
    /// default something white in the sun has a radiance of about 1.
    double scale = 0.02;
    int height = 256;  ///< of the map in pixels, 2 to 8192; its width is twice as much
};

/// Daylight: `scene.environment = sky.environment; scene.add(sky.sun);`
struct Sky {
    std::shared_ptr<const EnvironmentMap> environment;  ///< of the sky without the Sun, and the ground
    SunLight sun;                                       ///< yellow and weaker where it is low
};

/// Preetham, Shirley, Smits, A Practical Analytic Model for Daylight, SIGGRAPH 1999: the sky by its appendix on the
/// distribution of skylight; the Sun by that on transmittance, with Rayleigh scattering and aerosols at 680, 550 and
/// 440 nm, from 128 klx above the air.
///
/// \throws ArgumentError that names the field
Sky make_sky(const SkySettings& settings = {});

}  // namespace limn
