// Bindings of the lights that aren't shapes: backgrounds, environment maps, points, spots, suns, the sky.
#include "limn/scene/lights.h"

#include <nanobind/stl/shared_ptr.h>

#include <limits>

#include "bindings.h"
#include "images.h"
#include "limn/scene/background.h"
#include "limn/scene/environment.h"
#include "limn/scene/sky.h"

namespace limn::python {

namespace {

void bind_background(nb::module_& module) {
    nb::class_<Background>(module, "Background", "Linear radiance that arrives from infinitely far away.")
        .def_static(
            "black", [] { return Background::black(); }, "Returns a background without light.")
        .def_static(
            "constant", [](TripleArgument value) { return Background::constant(color(value.object, "color")); },
            given("color"), R"(Returns a background of the same radiance in all directions.

Args:
    color: linear red, green, blue, finite and at least 0.)")
        .def_static(
            "gradient",
            [](TripleArgument bottom, TripleArgument top) {
                return Background::gradient(color(bottom.object, "bottom"), color(top.object, "top"));
            },
            given("bottom"), given("top"),
            R"(Returns a background whose radiance is linear in the y of the unit direction.

Args:
    bottom: linear red, green, blue of the direction straight down, finite and at least 0.
    top: the same of the direction straight up.)");
}

void bind_environment(nb::module_& module) {
    nb::class_<EnvironmentMap>(module, "EnvironmentMap", "An image of the light from all directions.")
        .def(
            "__init__",
            [](EnvironmentMap* self, ArrayArgument image, MatrixArgument turned, NumberArgument scale) {
                const Transform world_from_map =
                    turned.object.is_none() ? Transform{} : matrix(turned, "world_from_map");
                new (self) EnvironmentMap(image_of(image), world_from_map, number(scale, "scale"));
            },
            given("image"), given("world_from_map") = nb::none(), given("scale") = 1.0,
            R"(Makes a map from an equirectangular image.

The upper edge of the image is +y, its middle is -z, and +x is to the right of the middle.

Args:
    image: the radiance, finite and at least 0: shape (height, width, 3) of any height and width, rows from the top.
        float64 and float32 are linear. uint8 is decoded from sRGB.
    world_from_map: a rotation or a rotation with a reflection: shape (3, 4) or (4, 4). None is the identity.
    scale: a factor of the radiance, at least 0.)");
}

void bind_punctual(nb::module_& module) {
    nb::class_<PointLight>(module, "PointLight", "A point that emits the same intensity in all directions.")
        .def(
            "__init__",
            [](PointLight* self, TripleArgument position, TripleArgument intensity) {
                new (self) PointLight{.position = point(position, "position"),
                                      .intensity = color(intensity.object, "intensity")};
            },
            given("position"), given("intensity"),
            R"(Makes a point light.

Cameras and mirrors do not see it, and the estimator "naive" renders without it.

Args:
    position: in world units.
    intensity: red, green, blue in W / sr, at least 0. The irradiance at a distance d is intensity / d^2.)");
    nb::class_<SpotLight>(module, "SpotLight", "A point that emits light into a cone.")
        .def(
            "__init__",
            [](SpotLight* self, TripleArgument position, TripleArgument direction, TripleArgument intensity,
               NumberArgument inner, NumberArgument outer) {
                new (self) SpotLight{.position = point(position, "position"),
                                     .direction = vector(direction, "direction"),
                                     .intensity = color(intensity.object, "intensity"),
                                     .inner_cone_angle = number(inner, "inner_cone_angle"),
                                     .outer_cone_angle = number(outer, "outer_cone_angle")};
            },
            given("position"), given("direction"), given("intensity"), given("inner_cone_angle") = 0.0,
            given("outer_cone_angle") = 45.0,
            R"(Makes a spot light as in glTF's KHR_lights_punctual.

Cameras and mirrors do not see it, and the estimator "naive" renders without it.

Args:
    position: in world units.
    direction: the axis of the cone, away from the light. It may have any length but 0.
    intensity: red, green, blue on the axis, in W / sr, at least 0.
    inner_cone_angle: degrees from the axis up to which the intensity is full.
    outer_cone_angle: degrees from the axis from which on the intensity is 0. It is over 0, at most 90, and not below
        inner_cone_angle.)");
    nb::class_<DirectionalLight>(module, "DirectionalLight", "Light from infinitely far away that has one direction.")
        .def(
            "__init__",
            [](DirectionalLight* self, TripleArgument direction, TripleArgument irradiance) {
                new (self) DirectionalLight{.direction = vector(direction, "direction"),
                                            .irradiance = color(irradiance.object, "irradiance")};
            },
            given("direction"), given("irradiance"),
            R"(Makes a directional light.

Cameras and mirrors do not see it, and the estimator "naive" renders without it.

Args:
    direction: the direction in which the light travels. It may have any length but 0.
    irradiance: red, green, blue on a plane perpendicular to the direction, in W / m^2, at least 0.)");
    nb::class_<SunLight>(module, "SunLight", "A disc infinitely far away. Cameras and mirrors see it.")
        .def(
            "__init__",
            [](SunLight* self, TripleArgument direction, TripleArgument irradiance, NumberArgument radius) {
                new (self) SunLight{.direction = vector(direction, "direction"),
                                    .irradiance = color(irradiance.object, "irradiance"),
                                    .angular_radius = number(radius, "angular_radius")};
            },
            given("direction"), given("irradiance"), given("angular_radius") = SunLight{}.angular_radius,
            R"(Makes a sun. Its radiance is the same all over the disc.

Args:
    direction: the direction in which the light of the disc's centre travels. It may have any length but 0.
    irradiance: red, green, blue on a plane perpendicular to the direction, in W / m^2, at least 0.
    angular_radius: in degrees, over 0, at most 90. The default is that of the Sun seen from the Earth.)");
}

void bind_sky(nb::module_& module) {
    nb::class_<Sky>(module, "Sky", "Daylight. To use it: scene.environment = sky.environment; scene.add(sky.sun)")
        .def_prop_ro(
            "environment", [](const Sky& sky) { return std::const_pointer_cast<EnvironmentMap>(sky.environment); },
            "The EnvironmentMap of the sky without the Sun, and of the ground.")
        .def_prop_ro(
            "sun", [](const Sky& sky) { return sky.sun; }, "The SunLight. A low Sun is yellower and weaker.");
    module.def(
        "make_sky",
        [](TripleArgument to_sun, NumberArgument turbidity, TripleArgument ground, NumberArgument scale,
           CountArgument height) {
            constexpr long long kMost = std::numeric_limits<int>::max();
            return make_sky({.to_sun = vector(to_sun, "to_sun"),
                             .turbidity = number(turbidity, "turbidity"),
                             .ground = color(ground.object, "ground"),
                             .scale = number(scale, "scale"),
                             .height = static_cast<int>(whole(height, "height", 1, kMost))});
        },
        nb::kw_only(), given("to_sun") = nb::make_tuple(0.4, 0.7, 0.6), given("turbidity") = 3.0,
        given("ground") = nb::make_tuple(0.25, 0.25, 0.25), given("scale") = 0.02, given("height") = 256,
        R"(Returns daylight by the model of Preetham, Shirley and Smits (1999).

Args:
    to_sun: the direction towards the Sun, of any length. Its y is over 0.
    turbidity: how hazy the air is, from 2 (clear) to 10 (haze).
    ground: albedo of the ground below the horizon, red, green, blue in [0, 1].
    scale: a factor of the radiance. At 1 a luminance of 683 cd / m^2 is radiance 1. At the default a white surface in
        the sun has a radiance of about 1.
    height: height of the map in pixels, 2 to 8192. Its width is twice the height.

Returns:
    A Sky.)");
}

}  // namespace

void bind_lights(nb::module_& module) {
    bind_background(module);
    bind_environment(module);
    bind_punctual(module);
    bind_sky(module);
}

}  // namespace limn::python
