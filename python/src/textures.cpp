// Colours that vary.
#include "limn/texture/texture.h"

#include <nanobind/stl/shared_ptr.h>

#include <array>
#include <cstdint>
#include <limits>

#include "arguments.h"
#include "bindings.h"
#include "images.h"
#include "limn/texture/checker.h"
#include "limn/texture/image_texture.h"
#include "limn/texture/perlin.h"
#include "limn/texture/solid.h"

namespace limn::python {

namespace {

std::shared_ptr<const Texture> texture(ColorArgument argument, const char* name) {
    std::shared_ptr<Texture> given;
    if (!argument.object.is_none() && nb::try_cast(argument.object, given)) return given;
    return std::make_shared<SolidColor>(color(argument.object, name));
}

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
            "scale: in cells per world unit. color: what the noise multiplies, linear.");
}

}  // namespace

void bind_textures(nb::module_& module) {
    nb::class_<Texture>(module, "Texture", "A colour that varies over a surface or through space. Linear BT.709.");
    nb::class_<SolidColor, Texture>(module, "SolidColor", "The same colour everywhere.")
        .def(
            "__init__",
            [](SolidColor* self, TripleArgument value) { new (self) SolidColor(color(value.object, "color")); },
            given("color"));
    nb::class_<Checker, Texture>(module, "Checker", "Space cut into cubes in two textures by turns.")
        .def(
            "__init__",
            [](Checker* self, NumberArgument scale, ColorArgument even, ColorArgument odd) {
                new (self) Checker(number(scale, "scale"), texture(even, "even"), texture(odd, "odd"));
            },
            given("scale"), given("even"), given("odd"), "scale: side of a cube, in world units.");
    nb::class_<ImageTexture, Texture>(module, "ImageTexture", "A picture over the texture coordinates.")
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
            "image: shape (height, width, 3), rows from the top; float64 or float32 are linear, uint8 is sRGB.\n"
            "filter: 'nearest' or 'bilinear'. wrap: 'repeat', 'clamp' or 'mirror', outside of [0, 1].");
    bind_noise<Noise>(module, "Noise", "Perlin noise: color * (1 + noise) / 2.");
    bind_noise<Turbulence>(module, "Turbulence", "color * turbulence, of seven octaves.");
    bind_noise<Marble>(module, "Marble", "Stripes along z, bent by turbulence.");
}

}  // namespace limn::python
