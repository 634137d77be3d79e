/// \file
/// Daylight from a formula.
#pragma once

#include <memory>

#include "limn/math/color.h"
#include "limn/math/vec.h"
#include "limn/scene/environment.h"
#include "limn/scene/lights.h"

namespace limn {

/// Parameters of make_sky.
struct SkySettings {
    Vec3 to_sun{0.4, 0.7, 0.6};      ///< direction towards the Sun; of any length, with y > 0
    double turbidity = 3;            ///< haze of the air, from 2 (clear) to 10 (hazy)
    Color ground{0.25, 0.25, 0.25};  ///< albedo of the ground below the horizon, in [0, 1]
    /// Factor of the radiance; finite, not negative. At 1, a luminance of 683 cd / m^2 is a radiance of 1, and the Sun
    /// at noon has an irradiance of 150 W / m^2. With the default, a white surface in the sun has a radiance of about
    /// 1.
    double scale = 0.02;
    int height = 256;  ///< height of the map in pixels, 2 to 8192; the width is twice the height
};

/// Daylight. Add it by `scene.environment = sky.environment; scene.add(sky.sun);`.
struct Sky {
    std::shared_ptr<const EnvironmentMap> environment;  ///< the sky without the Sun, and the ground
    SunLight sun;                                       ///< the Sun; yellower and weaker near the horizon
};

/// Returns the daylight of Preetham, Shirley and Smits, A Practical Analytic Model for Daylight, SIGGRAPH 1999. The sky
/// follows the paper's appendix on the distribution of skylight. The Sun follows its appendix on transmittance: an
/// illuminance of 128 klx above the air is weakened by Rayleigh scattering and aerosols at 680, 550 and 440 nm.
///
/// \throws ArgumentError if a field is outside its range; the message names the field
Sky make_sky(const SkySettings& settings = {});

}  // namespace limn
