/// \file
/// Lights that are no shapes: they light surfaces and media, and cast sharp shadows if they have no extent.
///
/// Only light sampling finds lights without extent. So mirrors and cameras do not see them, and Estimator::naive
/// renders without them.
#pragma once

#include <variant>

#include "limn/core/color.h"
#include "limn/core/vec.h"

namespace limn {

/// A point that shines alike into all directions: the irradiance at a distance d, across the way, is intensity / d^2.
struct PointLight {
    Point3 position;           ///< finite
    Color intensity{1, 1, 1};  ///< in W / sr; finite, not negative
};

/// A point that shines into a cone, as glTF's KHR_lights_punctual has it: the intensity is multiplied by the square of
/// (cos a - cos outer) / (cos inner - cos outer), clamped to [0, 1], at the angle a from the axis.
struct SpotLight {
    Point3 position;               ///< finite
    Vec3 direction{0, 0, -1};      ///< of the axis, into which it shines; of any length but 0
    Color intensity{1, 1, 1};      ///< on the axis, in W / sr; finite, not negative
    double inner_cone_angle = 0;   ///< degrees from the axis: up to here all of the intensity
    double outer_cone_angle = 45;  ///< degrees from the axis: from here on none. inner <= outer, 0 < outer <= 90
};

/// Light of one direction, from infinitely far away.
struct DirectionalLight {
    Vec3 direction{0, -1, 0};   ///< into which it shines, of any length but 0
    Color irradiance{1, 1, 1};  ///< of a plane across the direction, in W / m^2; finite, not negative
};

/// A disc infinitely far away, of the same radiance all over, which cameras and mirrors see: irradiance / (pi sin^2 r)
/// with r = angular_radius.
struct SunLight {
    Vec3 direction{0, -1, 0};        ///< into which its middle shines, of any length but 0
    Color irradiance{1, 1, 1};       ///< of a plane across the direction, in W / m^2; finite, not negative
    double angular_radius = 0.2666;  ///< degrees; above 0, at most 90. The Sun's from the Earth: 0.262 to 0.271
};

/// Any of them.
using LightSource = std::variant<PointLight, SpotLight, DirectionalLight, SunLight>;

}  // namespace limn
