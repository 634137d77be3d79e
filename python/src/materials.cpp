// What surfaces are made of.
#include "limn/material/dielectric.h"
#include "limn/material/diffuse_light.h"
#include "limn/material/isotropic.h"
#include "limn/material/lambertian.h"
#include "limn/material/metal.h"
#include "limn/material/oren_nayar.h"

#include <nanobind/stl/shared_ptr.h>

#include "arguments.h"
#include "bindings.h"
#include "limn/texture/solid.h"
#include "limn/texture/texture.h"

namespace limn::python {

namespace {

// A material of a texture, or of a colour.
template <class Made, class... Rest>
void make(void* place, ColorArgument argument, const char* name, Rest... rest) {
    std::shared_ptr<Texture> texture;
    if (!argument.object.is_none() && nb::try_cast(argument.object, texture))
        new (place) Made(std::shared_ptr<const Texture>(std::move(texture)), rest...);
    else
        new (place) Made(color(argument.object, name), rest...);
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
            [](DiffuseLight* self, ColorArgument radiance) { make<DiffuseLight>(self, radiance, "radiance"); },
            given("radiance"), "radiance: linear red, green, blue, at least 0, or a texture.");
    nb::class_<Isotropic, Material>(module, "Isotropic", "Scatters into all directions alike.")
        .def(
            "__init__", [](Isotropic* self, ColorArgument albedo) { make<Isotropic>(self, albedo, "albedo"); },
            given("albedo"), "albedo: linear red, green, blue in [0, 1], or a texture.");
}

}  // namespace limn::python
