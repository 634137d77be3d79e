// What surfaces are made of. Those of microfacets stand in microfacets.cpp.
#include "limn/material/material.h"

#include "limn/material/alpha_mask.h"
#include "limn/material/dielectric.h"
#include "limn/material/diffuse_light.h"
#include "limn/material/isotropic.h"
#include "limn/material/lambertian.h"
#include "limn/material/metal.h"
#include "limn/material/normal_map.h"
#include "limn/material/oren_nayar.h"

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
    nb::class_<NormalMap, Material>(module, "NormalMap", "Another material around normals that a texture bends.")
        .def(
            "__init__",
            [](NormalMap* self, SurfaceArgument material, TextureArgument normals) {
                new (self) NormalMap(material_of(material), shared<Texture>(normals.object, "normals", "a Texture"));
            },
            given("material"), given("normals"),
            R"(Needs a mesh with uvs, or another shape that has texture coordinates.

Args:
    material: any but a NormalMap.
    normals: a texture whose red, green and blue, from 0 to 1, are the coordinates from -1 to 1 along u, along v and
        along the normal, as in glTF. Its numbers are linear: an ImageTexture of bytes has to be made of
        pixels / numpy.float32(255), as uint8 counts as sRGB.)");
    nb::class_<AlphaMask, Material>(module, "AlphaMask", "Another material with holes: leaves, fences, worn cloth.")
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
            R"(Renders see the holes, for shadows too; queries do not.

Args:
    material: what there is between the holes.
    opacity: in [0, 1], how much of the light the surface stops, or a texture whose red says so. Its numbers are
        linear: see NormalMap.
    cutoff: in [0, 1]; if over 0, the surface stops all light where the texture is at least that, and none elsewhere.)");
}

}  // namespace

void bind_materials(nb::module_& module) {
    nb::class_<Material>(module, "Material", "How a surface scatters and emits light.");
    nb::class_<Lambertian, Material>(module, "Lambertian", "The ideal diffuse reflector, on both sides.")
        .def(
            "__init__", [](Lambertian* self, ColorArgument albedo) { make<Lambertian>(self, albedo, "albedo"); },
            given("albedo"), "albedo: linear red, green, blue in [0, 1], or a texture.");
    nb::class_<OrenNayar, Material>(module, "OrenNayar", "A rough diffuse reflector: clay, plaster, the Moon.")
        .def(
            "__init__",
            [](OrenNayar* self, ColorArgument albedo, NumberArgument roughness) {
                make<OrenNayar>(self, albedo, "albedo", number(roughness, "roughness"));
            },
            given("albedo"), given("roughness"), "roughness: 0 (Lambertian) to 1.");
    nb::class_<Metal, Material>(module, "Metal", "A mirror, or brushed metal.")
        .def(
            "__init__",
            [](Metal* self, ColorArgument albedo, NumberArgument fuzz) {
                make<Metal>(self, albedo, "albedo", number(fuzz, "fuzz"));
            },
            given("albedo"), given("fuzz") = 0.0,
            "fuzz: 0 (a perfect mirror) to 1, the radius of the ball that displaces the reflected unit direction.");
    nb::class_<Dielectric, Material>(module, "Dielectric", "A smooth interface to glass or water.")
        .def(
            "__init__",
            [](Dielectric* self, NumberArgument index, NameArgument fresnel) {
                const bool exact = choice(fresnel, "fresnel", {"exact", "schlick"}) == 0;
                new (self) Dielectric(number(index, "index"), exact ? Fresnel::exact : Fresnel::schlick);
            },
            given("index"), given("fresnel") = "exact",
            "index: of refraction, inside over outside. fresnel: 'exact' or 'schlick'.");
    nb::class_<DiffuseLight, Material>(module, "DiffuseLight", "A lamp: the same radiance in every direction.")
        .def(
            "__init__",
            [](DiffuseLight* self, ColorArgument radiance, NameArgument sides) {
                make<DiffuseLight>(self, radiance, "radiance",
                                   std::array{Sides::both, Sides::front,
                                              Sides::back}[choice(sides, "sides", {"both", "front", "back"})]);
            },
            given("radiance"), given("sides") = "both",
            "radiance: linear red, green, blue in W / (sr m^2), at least 0, or a texture.\n"
            "sides: which shine, 'both', 'front' (that of the outward normal) or 'back'.");
    nb::class_<Isotropic, Material>(module, "Isotropic", "Scatters into all directions alike.")
        .def(
            "__init__", [](Isotropic* self, ColorArgument albedo) { make<Isotropic>(self, albedo, "albedo"); },
            given("albedo"), "albedo: linear red, green, blue in [0, 1], or a texture.");
    bind_microfacets(module);
    bind_wrappers(module);
}

}  // namespace limn::python
