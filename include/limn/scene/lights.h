/// \file
/// Lights that aren't shapes. They illuminate surfaces and media.
///
/// Point, spot and directional lights have no extent. They cast sharp shadows, and only light sampling finds them:
/// mirrors and cameras do not see them, and Estimator::naive renders without them. Scene::add throws ArgumentError if a
/// field is outside the range stated here.
#pragma once

#include <variant>

#include "limn/math/color.h"
#include "limn/math/vec.h"

namespace limn {

/// A point that emits the same intensity in all directions. A surface at distance d that is perpendicular to the
/// direction of the light receives the irradiance intensity / d^2.
struct PointLight {
    Point3 position;           ///< finite
    Color intensity{1, 1, 1};  ///< in W / sr; finite, not negative
};

/// A point that emits into a cone, as in glTF's KHR_lights_punctual. At an angle a from the axis the intensity is
/// multiplied by the square of (cos a - cos outer) / (cos inner - cos outer), after clamping that ratio to [0, 1].
struct SpotLight {
    Point3 position;               ///< finite
    Vec3 direction{0, 0, -1};      ///< axis of the cone, away from the light; of any length but 0
    Color intensity{1, 1, 1};      ///< intensity on the axis, in W / sr; finite, not negative
    double inner_cone_angle = 0;   ///< degrees from the axis; the intensity is full up to here
    double outer_cone_angle = 45;  ///< degrees from the axis; 0 beyond. 0 <= inner <= outer, 0 < outer <= 90
};

/// Light that arrives from infinitely far away in a single direction.
struct DirectionalLight {
    Vec3 direction{0, -1, 0};   ///< direction in which the light travels; of any length but 0
    Color irradiance{1, 1, 1};  ///< irradiance of a plane perpendicular to it, in W / m^2; finite, not negative
};

/// A disc infinitely far away. Cameras and mirrors see it. Its radiance is the same all over: irradiance / (pi s^2)
/// with s = sin(angular_radius).
struct SunLight {
    Vec3 direction{0, -1, 0};        ///< direction in which light from its centre travels; of any length but 0
    Color irradiance{1, 1, 1};       ///< irradiance of a plane perpendicular to it, in W / m^2; finite, not negative
    double angular_radius = 0.2666;  ///< degrees, in (0, 90]; the Sun seen from the Earth has 0.262 to 0.271
};

/// A light that isn't a shape.
using LightSource = std::variant<PointLight, SpotLight, DirectionalLight, SunLight>;

}  // namespace limn
