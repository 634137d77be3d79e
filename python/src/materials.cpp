// Bindings of the materials. Those with microfacets are in microfacets.cpp.
#include "limn/scene/material/material.h"

#include "limn/scene/material/alpha_mask.h"
#include "limn/scene/material/dielectric.h"
#include "limn/scene/material/diffuse_light.h"
#include "limn/scene/material/isotropic.h"
#include "limn/scene/material/lambertian.h"
#include "limn/scene/material/metal.h"
#include "limn/scene/material/normal_map.h"
#include "limn/scene/material/oren_nayar.h"

#include <nanobind/stl/shared_ptr.h>

#include <array>

#include "bindings.h"
#include "materials.h"

namespace limn::python {

namespace {

std::shared_ptr<const Material> material_of(SurfaceArgument argument) {
    return shared<Material>(argument.object, "material", "a Material");
}

void bind_wrappers(nb::module_& module) {
    nb::class_<NormalMap, Material>(module, "NormalMap",
                                    "Another material whose shading normals are changed by a texture.")
        .def(
            "__init__",
            [](NormalMap* self, SurfaceArgument material, TextureArgument normals) {
                new (self) NormalMap(material_of(material), shared<Texture>(normals.object, "normals", "a Texture"));
            },
            given("material"), given("normals"),
            R"(Wraps a material.

The shape must be a mesh with uvs, or another shape that has texture coordinates.

Args:
    material: the other material. It must not be a NormalMap.
    normals: a texture. Its red, green and blue, from 0 to 1, encode the normal's coordinates from -1 to 1 along u, v
        and the shading normal, as in glTF. The values are linear. uint8 counts as sRGB, so make the ImageTexture from
        pixels / numpy.float32(255).)");
    nb::class_<AlphaMask, Material>(module, "AlphaMask",
                                    "Another material with holes, for leaves, fences or worn cloth.")
        .def(
            "__init__",
            [](AlphaMask* self, SurfaceArgument material, OpacityArgument opacity, NumberArgument cutoff) {
                const std::shared_ptr<const Material> of = material_of(material);
                const double edge = number(cutoff, "cutoff");
                std::shared_ptr<Texture> texture;
                if (!opacity.object.is_none() && nb::try_cast(opacity.object, texture)) {
                    new (self) AlphaMask(of, std::shared_ptr<const Texture>(std::move(texture)), edge);
                    return;
                }
                const double share = number({opacity.object}, "opacity");
                if (edge != 0) wrong_value("cutoff", "needs an opacity that is a texture");
                new (self) AlphaMask(of, share);
            },
            given("material"), given("opacity"), given("cutoff") = 0.0,
            R"(Wraps a material.

In renders light passes through the holes, so that shadows have holes too. Queries ignore the holes.

Args:
    material: the other material. It must not be an AlphaMask.
    opacity: the part of the light that the surface stops, in [0, 1]: a number, or a texture whose red is that part. The
        values are linear. uint8 counts as sRGB, so make the ImageTexture from pixels / numpy.float32(255).
    cutoff: in [0, 1]. If it is over 0, opacity must be a texture. The surface then stops all light where the texture's
        red is at least cutoff, and none elsewhere.)");
}

}  // namespace

void bind_materials(nb::module_& module) {
    nb::class_<Material>(module, "Material", "How a surface scatters and emits light.");
    nb::class_<Lambertian, Material>(module, "Lambertian", "The ideal diffuse reflector. It reflects on both sides.")
        .def(
            "__init__", [](Lambertian* self, ColorArgument albedo) { make<Lambertian>(self, albedo, "albedo"); },
            given("albedo"), R"(Makes a diffuse reflector.

Args:
    albedo: linear red, green, blue in [0, 1], or a texture.)");
    nb::class_<OrenNayar, Material>(module, "OrenNayar",
                                    "A rough diffuse reflector, such as clay, plaster or the Moon.")
        .def(
            "__init__",
            [](OrenNayar* self, ColorArgument albedo, NumberArgument roughness) {
                make<OrenNayar>(self, albedo, "albedo", number(roughness, "roughness"));
            },
            given("albedo"), given("roughness"), R"(Makes a reflector by the model of Oren and Nayar.

Args:
    albedo: linear red, green, blue in [0, 1], or a texture. An albedo of 1 loses no light.
    roughness: from 0, which is Lambertian, to 1.)");
    nb::class_<Metal, Material>(module, "Metal", "A mirror, or brushed metal.")
        .def(
            "__init__",
            [](Metal* self, ColorArgument albedo, NumberArgument fuzz) {
                make<Metal>(self, albedo, "albedo", number(fuzz, "fuzz"));
            },
            given("albedo"), given("fuzz") = 0.0,
            R"(Makes a metal that reflects `albedo` at every angle, without a Fresnel term.

Args:
    albedo: linear red, green, blue in [0, 1], or a texture.
    fuzz: from 0, a perfect mirror, to 1. A random point in the ball of this radius is added to the reflected unit
        direction.)");
    nb::class_<Dielectric, Material>(module, "Dielectric", "A smooth interface to glass or water.")
        .def(
            "__init__",
            [](Dielectric* self, NumberArgument index, NameArgument fresnel) {
                const bool exact = choice(fresnel, "fresnel", {"exact", "schlick"}) == 0;
                new (self) Dielectric(number(index, "index"), exact ? Fresnel::exact : Fresnel::schlick);
            },
            given("index"), given("fresnel") = "exact",
            R"(Makes an interface that reflects and refracts.

Args:
    index: index of refraction of the inside over that of the outside, over 0.
    fresnel: the formula of the reflectance: "exact" (Fresnel's equations) or "schlick" (Schlick's approximation).)");
    nb::class_<DiffuseLight, Material>(module, "DiffuseLight",
                                       "A lamp that emits the same radiance in every direction.")
        .def(
            "__init__",
            [](DiffuseLight* self, ColorArgument radiance, NameArgument sides) {
                make<DiffuseLight>(self, radiance, "radiance",
                                   std::array{Sides::both, Sides::front,
                                              Sides::back}[choice(sides, "sides", {"both", "front", "back"})]);
            },
            given("radiance"), given("sides") = "both",
            R"(Makes a lamp, which scatters no light.

Args:
    radiance: linear red, green, blue in W / (sr m^2), at least 0, or a texture.
    sides: the sides that emit: "both", "front" (the side of the outward normal) or "back".)");
    nb::class_<Isotropic, Material>(module, "Isotropic", "A phase function that is the same in all directions.")
        .def(
            "__init__", [](Isotropic* self, ColorArgument albedo) { make<Isotropic>(self, albedo, "albedo"); },
            given("albedo"), R"(Makes a phase function.

Args:
    albedo: linear red, green, blue in [0, 1], or a texture.)");
    bind_microfacets(module);
    bind_wrappers(module);
}

}  // namespace limn::python
