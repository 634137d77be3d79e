// Light that comes from no shape: backgrounds, environment maps, points, spots, suns, the sky.
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
    nb::class_<Background>(module, "Background", "Radiance that arrives from infinitely far away, linear.")
        .def_static(
            "black", [] { return Background::black(); }, "None.")
        .def_static(
            "constant", [](TripleArgument value) { return Background::constant(color(value.object, "color")); },
            given("color"), "The same from everywhere.")
        .def_static(
            "gradient",
            [](TripleArgument bottom, TripleArgument top) {
                return Background::gradient(color(bottom.object, "bottom"), color(top.object, "top"));
            },
            given("bottom"), given("top"), "From straight below to straight above, linear in y.");
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
            R"(Equirectangular: the upper edge is +y, the middle -z, and +x is to the right of that.

Args:
    image: shape (height, width, 3) of any height and width, rows from the top, radiance, finite and at least 0;
        float64 or float32 are linear, uint8 is sRGB.
    world_from_map: shape (3, 4) or (4, 4), a rotation, which may mirror too; None: as it is.
    scale: multiplies the radiance, at least 0.)");
}

void bind_punctual(nb::module_& module) {
    nb::class_<PointLight>(module, "PointLight", "A point that shines alike into all directions.")
        .def(
            "__init__",
            [](PointLight* self, TripleArgument position, TripleArgument intensity) {
                new (self) PointLight{.position = point(position, "position"),
                                      .intensity = color(intensity.object, "intensity")};
            },
            given("position"), given("intensity"),
            "intensity: red, green, blue in W / sr, at least 0: the irradiance at a distance d is intensity / d^2.");
    nb::class_<SpotLight>(module, "SpotLight", "A point that shines into a cone.")
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
            R"(As glTF's KHR_lights_punctual has it.

Args:
    position: in world units.
    direction: into which it shines, of any length but 0.
    intensity: red, green, blue on the axis, in W / sr, at least 0.
    inner_cone_angle: degrees from the axis: up to here all of the intensity.
    outer_cone_angle: degrees from the axis, over 0, at most 90: from here on none.)");
    nb::class_<DirectionalLight>(module, "DirectionalLight", "Light of one direction, from infinitely far away.")
        .def(
            "__init__",
            [](DirectionalLight* self, TripleArgument direction, TripleArgument irradiance) {
                new (self) DirectionalLight{.direction = vector(direction, "direction"),
                                            .irradiance = color(irradiance.object, "irradiance")};
            },
            given("direction"), given("irradiance"),
            "direction: into which it shines, of any length but 0.\n"
            "irradiance: red, green, blue of a plane across the direction, in W / m^2, at least 0.");
    nb::class_<SunLight>(module, "SunLight", "A disc infinitely far away, which cameras and mirrors see.")
        .def(
            "__init__",
            [](SunLight* self, TripleArgument direction, TripleArgument irradiance, NumberArgument radius) {
                new (self) SunLight{.direction = vector(direction, "direction"),
                                    .irradiance = color(irradiance.object, "irradiance"),
                                    .angular_radius = number(radius, "angular_radius")};
            },
            given("direction"), given("irradiance"), given("angular_radius") = SunLight{}.angular_radius,
            R"(Of the same radiance all over.

Args:
    direction: into which its middle shines, of any length but 0.
    irradiance: red, green, blue of a plane across the direction, in W / m^2, at least 0.
    angular_radius: in degrees, over 0, at most 90; by default the Sun's, seen from the Earth.)");
}

void bind_sky(nb::module_& module) {
    nb::class_<Sky>(module, "Sky", "Daylight: scene.environment = sky.environment; scene.add(sky.sun).")
        .def_prop_ro(
            "environment", [](const Sky& sky) { return std::const_pointer_cast<EnvironmentMap>(sky.environment); },
            "An EnvironmentMap of the sky without the Sun, and the ground.")
        .def_prop_ro(
            "sun", [](const Sky& sky) { return sky.sun; }, "A SunLight, yellow and weaker where it is low.");
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
        R"(Daylight after Preetham, Shirley and Smits (1999).

Args:
    to_sun: towards the Sun, of any length, y over 0.
    turbidity: how hazy the air is: 2 (clear) to 10 (haze).
    ground: albedo of what is below the horizon, red, green, blue in [0, 1].
    scale: of the radiance. At 1 a luminance of 683 cd / m^2 is radiance 1; with the default something white in the sun
        has a radiance of about 1.
    height: of the map in pixels, 2 to 8192.

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
