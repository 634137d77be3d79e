// Bindings of the textures.
#include "limn/scene/texture/texture.h"

#include <nanobind/stl/shared_ptr.h>

#include <array>
#include <cstdint>
#include <limits>

#include "arguments.h"
#include "bindings.h"
#include "images.h"
#include "limn/scene/texture/checker.h"
#include "limn/scene/texture/image_texture.h"
#include "limn/scene/texture/perlin.h"
#include "limn/scene/texture/solid.h"

namespace limn::python {

namespace {

// Returns the texture of an argument that is a texture or a colour.
std::shared_ptr<const Texture> texture(ColorArgument argument, const char* name) {
    std::shared_ptr<Texture> given;
    if (!argument.object.is_none() && nb::try_cast(argument.object, given)) return given;
    return std::make_shared<SolidColor>(color(argument.object, name));
}

// Binds Noise, Turbulence or Marble. `what` is the docstring of the class.
template <class Made>
void bind_noise(nb::module_& module, const char* name, const char* what) {
    nb::class_<Made, Texture>(module, name, what)
        .def(
            "__init__",
            [](Made* self, NumberArgument scale, CountArgument seed, TripleArgument tint) {
                new (self)
                    Made(number(scale, "scale"),
                         static_cast<std::uint64_t>(whole(seed, "seed", 0, std::numeric_limits<long long>::max())),
                         color(tint.object, "color"));
            },
            given("scale"), given("seed") = 0, given("color") = nb::make_tuple(1.0, 1.0, 1.0),
            R"(Makes a texture of Perlin noise.

Args:
    scale: cells of the noise per world unit.
    seed: an integer of at least 0. Another seed gives another lattice.
    color: the colour that the noise multiplies: linear red, green, blue, at least 0.)");
}

}  // namespace

void bind_textures(nb::module_& module) {
    nb::class_<Texture>(module, "Texture", "A colour that varies over a surface or through space. Linear BT.709.");
    nb::class_<SolidColor, Texture>(module, "SolidColor", "A texture of one colour.")
        .def(
            "__init__",
            [](SolidColor* self, TripleArgument value) { new (self) SolidColor(color(value.object, "color")); },
            given("color"), R"(Makes a texture of one colour.

Args:
    color: linear red, green, blue, at least 0; for an albedo in [0, 1].)");
    nb::class_<Checker, Texture>(module, "Checker", "A three-dimensional checkerboard of two textures.")
        .def(
            "__init__",
            [](Checker* self, NumberArgument scale, ColorArgument even, ColorArgument odd) {
                new (self) Checker(number(scale, "scale"), texture(even, "even"), texture(odd, "odd"));
            },
            given("scale"), given("even"), given("odd"), R"(Makes a checkerboard in world space.

Args:
    scale: side of a cube, in world units.
    even: the texture or colour of cubes whose indices floor(x / scale), floor(y / scale), floor(z / scale) have an even
        sum.
    odd: the texture or colour of the other cubes.)");
    nb::class_<ImageTexture, Texture>(module, "ImageTexture", "An image over the texture coordinates.")
        .def(
            "__init__",
            [](ImageTexture* self, ArrayArgument image, NameArgument filter, NameArgument wrap) {
                const ImageTextureOptions options{
                    .filter =
                        choice(filter, "filter", {"nearest", "bilinear"}) == 0 ? Filter::nearest : Filter::bilinear,
                    .wrap = std::array{Wrap::repeat, Wrap::clamp,
                                       Wrap::mirror}[choice(wrap, "wrap", {"repeat", "clamp", "mirror"})]};
                new (self) ImageTexture(image_of(image), options);
            },
            given("image"), given("filter") = "bilinear", given("wrap") = "repeat",
            R"(Makes a texture from a copy of an image. u runs to the right and v upward.

Args:
    image: shape (height, width, 3), rows from the top, finite and at least 0. float64 and float32 are linear. uint8 is
        decoded from sRGB.
    filter: "nearest" or "bilinear".
    wrap: the rule for coordinates outside [0, 1]: "repeat", "clamp" or "mirror".)");
    bind_noise<Noise>(module, "Noise", "Perlin noise in world space: color * (1 + noise) / 2.");
    bind_noise<Turbulence>(
        module, "Turbulence",
        "Turbulence in world space, the absolute value of seven octaves of Perlin noise: color * turbulence.");
    bind_noise<Marble>(module, "Marble", "Marble: stripes along the z axis of world space, distorted by turbulence.");
}

}  // namespace limn::python
