// Bindings of the materials with microfacets: rough metal, rough glass, plastic, and the mixture of metal and plastic.
#include "limn/scene/material/metallic_roughness.h"
#include "limn/scene/material/plastic.h"
#include "limn/scene/material/rough_conductor.h"
#include "limn/scene/material/rough_dielectric.h"
#include "limn/scene/texture/solid.h"
#include "materials.h"

namespace limn::python {

namespace {

// Returns a roughness from a number, or from two numbers along u and across it.
Roughness roughness_of(RoughnessArgument argument) {
    const nb::handle object = argument.object;
    if (!PySequence_Check(object.ptr()) || nb::isinstance<nb::str>(object)) return number({object}, "roughness");
    const std::vector<nb::object> both = items(object, 2, "roughness", "a number or two of them");
    return {number({both[0]}, "roughness"), number({both[1]}, "roughness")};
}

void bind_conductor(nb::module_& module) {
    nb::class_<RoughConductor, Material>(module, "RoughConductor", "Smooth or rough metal.")
        .def(
            "__init__",
            [](RoughConductor* self, ColorArgument reflectance, RoughnessArgument roughness, TripleArgument tint) {
                make<RoughConductor>(self, reflectance, "reflectance", roughness_of(roughness),
                                     color(tint.object, "edge_tint"));
            },
            given("reflectance"), given("roughness"), given("edge_tint") = nb::make_tuple(0.0, 0.0, 0.0),
            R"(Makes a metal from its reflectance.

The microfacets have the GGX distribution and reflect by Fresnel's equations. Light that they scatter more than once is
included, so that a metal of reflectance 1 loses no light.

Args:
    reflectance: reflectance at normal incidence, linear red, green, blue in [0, 1], or a texture.
    roughness: in [0, 1]. 0 is smooth. Its square is the alpha of the GGX distribution. Two numbers are the roughness
        along u and across u, for brushed metal.
    edge_tint: red, green, blue in [0, 1]. The larger it is, the earlier the reflectance rises towards grazing
        incidence.)")
        .def_static(
            "from_index",
            [](TripleArgument eta, TripleArgument k, RoughnessArgument roughness) {
                const ComplexIndex index{.eta = color(eta.object, "eta"), .k = color(k.object, "k")};
                return std::make_shared<RoughConductor>(index, roughness_of(roughness));
            },
            given("eta"), given("k"), given("roughness"),
            R"(Returns a metal of the complex index of refraction eta + i k, relative to the medium outside.

Args:
    eta: red, green, blue, over 0.
    k: red, green, blue, at least 0.
    roughness: one or two numbers, as for RoughConductor.)");
}

void make_plastic(Plastic* self, ColorArgument albedo, RoughnessArgument roughness, NumberArgument index,
                  ColorArgument specular) {
    const Roughness rough = roughness_of(roughness);
    const double n = number(index, "index");
    std::shared_ptr<Texture> coat;
    if (specular.object.is_none() || !nb::try_cast(specular.object, coat))
        return make<Plastic>(self, albedo, "albedo", rough, n, color(specular.object, "specular"));
    std::shared_ptr<Texture> below;
    if (albedo.object.is_none() || !nb::try_cast(albedo.object, below)) {
        const Color even = color(albedo.object, "albedo");
        if (!(max_component(even) <= 1)) wrong_value("albedo", "must be in [0, 1]");
        below = std::make_shared<SolidColor>(even);
    }
    new (self) Plastic(std::shared_ptr<const Texture>(below), rough, n, std::shared_ptr<const Texture>(coat));
}

void bind_metallic_roughness(nb::module_& module) {
    nb::class_<MetallicRoughness, Material>(module, "MetallicRoughness",
                                            "The metallic-roughness model of glTF: metal, plastic, or a mixture.")
        .def(
            "__init__",
            [](MetallicRoughness* self, ColorArgument base_color, NumberArgument metallic, NumberArgument roughness,
               NumberArgument index) {
                make<MetallicRoughness>(self, base_color, "base_color", number(metallic, "metallic"),
                                        number(roughness, "roughness"), number(index, "index"));
            },
            given("base_color"), given("metallic"), given("roughness"), given("index") = 1.5,
            R"(Makes a mixture of metal and plastic. A white one loses no light.

Args:
    base_color: the reflectance of the metal at normal incidence and the albedo of the plastic: linear red, green, blue
        in [0, 1], or a texture.
    metallic: the part of metal in the mixture, from 0 (plastic) to 1 (metal).
    roughness: in [0, 1]. Its square is the alpha of the GGX distribution. A value below 0.001 counts as 0.001.
    index: index of refraction of the plastic's coat, at least 1.)")
        .def_static(
            "from_textures",
            [](TextureArgument base_color, TextureArgument metallic_roughness, NumberArgument metallic,
               NumberArgument roughness, NumberArgument index) {
                return std::make_shared<MetallicRoughness>(
                    shared<Texture>(base_color.object, "base_color", "a Texture"),
                    shared<Texture>(metallic_roughness.object, "metallic_roughness", "a Texture"),
                    number(metallic, "metallic"), number(roughness, "roughness"), number(index, "index"));
            },
            given("base_color"), given("metallic_roughness"), given("metallic") = 1.0, given("roughness") = 1.0,
            given("index") = 1.5,
            R"(Returns a material that varies over the surface.

Args:
    base_color: a texture, used as by MetallicRoughness.
    metallic_roughness: a texture. Its green is multiplied by roughness and its blue by metallic. The products are
        clamped to [0, 1].
    metallic, roughness, index: as for MetallicRoughness.)");
}

}  // namespace

void bind_microfacets(nb::module_& module) {
    bind_conductor(module);
    bind_metallic_roughness(module);
    nb::class_<RoughDielectric, Material>(module, "RoughDielectric",
                                          "A rough interface to a clear medium, such as ground glass or ice.")
        .def(
            "__init__",
            [](RoughDielectric* self, NumberArgument index, RoughnessArgument roughness) {
                new (self) RoughDielectric(number(index, "index"), roughness_of(roughness));
            },
            given("index"), given("roughness"),
            R"(Makes a rough interface. With roughness 0 it equals a Dielectric.

Light that microfacets scatter more than once is lost. At an index of 1.5 and normal incidence that is 0.1 % of the
light at a roughness of 0.3, 0.8 % at 0.5 and 11 % at 1.

Args:
    index: index of refraction of the inside over that of the outside, over 0.
    roughness: one or two numbers, as for RoughConductor.)");
    nb::class_<Plastic, Material>(module, "Plastic", "A diffuse surface under a smooth or rough clear coat.")
        .def("__init__", &make_plastic, given("albedo"), given("roughness"), given("index") = 1.5,
             given("specular") = nb::make_tuple(1.0, 1.0, 1.0),
             R"(Makes a plastic. With an albedo of 1 it loses no light.

Args:
    albedo: the part of the light entering the coat that leaves it again: linear red, green, blue in [0, 1], or a
        texture.
    roughness: roughness of the coat, one or two numbers, as for RoughConductor.
    index: index of refraction of the coat, at least 1.
    specular: a factor of the light that the coat reflects: red, green, blue in [0, 1], or a texture.)");
}

}  // namespace limn::python
