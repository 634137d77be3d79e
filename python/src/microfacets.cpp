// Rough metal, rough glass, plastic, and their mixture.
#include "limn/material/metallic_roughness.h"
#include "limn/material/plastic.h"
#include "limn/material/rough_conductor.h"
#include "limn/material/rough_dielectric.h"
#include "limn/texture/solid.h"
#include "materials.h"

namespace limn::python {

namespace {

// A number, or two of them.
Roughness roughness_of(RoughnessArgument argument) {
    const nb::handle object = argument.object;
    if (!PySequence_Check(object.ptr()) || nb::isinstance<nb::str>(object)) return number({object}, "roughness");
    const std::vector<nb::object> both = items(object, 2, "roughness", "a number or two of them");
    return {number({both[0]}, "roughness"), number({both[1]}, "roughness")};
}

void bind_conductor(nb::module_& module) {
    nb::class_<RoughConductor, Material>(module, "RoughConductor", "Metal, smooth or rough, of microfacets.")
        .def(
            "__init__",
            [](RoughConductor* self, ColorArgument reflectance, RoughnessArgument roughness, TripleArgument tint) {
                make<RoughConductor>(self, reflectance, "reflectance", roughness_of(roughness),
                                     color(tint.object, "edge_tint"));
            },
            given("reflectance"), given("roughness"), given("edge_tint") = nb::make_tuple(0.0, 0.0, 0.0),
            R"(No light is lost: what facets scatter more than once is added.

Args:
    reflectance: at normal incidence, linear red, green, blue in [0, 1], or a texture.
    roughness: in [0, 1], 0 is smooth; its square is the alpha of the GGX distribution. Two numbers: along u and across
        it, which is brushed metal.
    edge_tint: red, green, blue in [0, 1]: how early it reflects more towards grazing incidence.)")
        .def_static(
            "from_index",
            [](TripleArgument eta, TripleArgument k, RoughnessArgument roughness) {
                const ComplexIndex index{.eta = color(eta.object, "eta"), .k = color(k.object, "k")};
                return std::make_shared<RoughConductor>(index, roughness_of(roughness));
            },
            given("eta"), given("k"), given("roughness"),
            R"(One of the complex index of refraction eta + i k, for red, green and blue, relative to what is outside.

Args:
    eta: three numbers over 0.
    k: three numbers, at least 0.
    roughness: as that of RoughConductor.)");
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
        if (!(max_component(even) <= 1)) wrong_value("albedo", "must lie in [0, 1]");
        below = std::make_shared<SolidColor>(even);
    }
    new (self) Plastic(std::shared_ptr<const Texture>(below), rough, n, std::shared_ptr<const Texture>(coat));
}

void bind_metallic_roughness(nb::module_& module) {
    nb::class_<MetallicRoughness, Material>(module, "MetallicRoughness",
                                            "The model of glTF: metal, varnish, or a mixture.")
        .def(
            "__init__",
            [](MetallicRoughness* self, ColorArgument base_color, NumberArgument metallic, NumberArgument roughness,
               NumberArgument index) {
                make<MetallicRoughness>(self, base_color, "base_color", number(metallic, "metallic"),
                                        number(roughness, "roughness"), number(index, "index"));
            },
            given("base_color"), given("metallic"), given("roughness"), given("index") = 1.5,
            R"(A white one loses no light.

Args:
    base_color: what metal reflects at normal incidence, and the albedo of the rest; linear red, green, blue in
        [0, 1], or a texture.
    metallic: 0 is Plastic, 1 metal.
    roughness: in [0, 1]; its square is the alpha of GGX. Below 0.001 it counts as 0.001.
    index: of refraction of the coat, at least 1.)")
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
            R"(One that varies over the surface.

Args:
    base_color: a texture.
    metallic_roughness: a texture whose green is multiplied by roughness and its blue by metallic.
    metallic, roughness, index: as before.)");
}

}  // namespace

void bind_microfacets(nb::module_& module) {
    bind_conductor(module);
    bind_metallic_roughness(module);
    nb::class_<RoughDielectric, Material>(module, "RoughDielectric", "Ground glass, frosted glass, ice.")
        .def(
            "__init__",
            [](RoughDielectric* self, NumberArgument index, RoughnessArgument roughness) {
                new (self) RoughDielectric(number(index, "index"), roughness_of(roughness));
            },
            given("index"), given("roughness"),
            R"(Of roughness 0 it is a Dielectric. Light that facets scatter more than once is lost: at an index of 1.5 and
normal incidence 0.1 % at a roughness of 0.3, 0.8 % at 0.5, 11 % at 1.

Args:
    index: of refraction, inside over outside, over 0.
    roughness: as that of RoughConductor.)");
    nb::class_<Plastic, Material>(module, "Plastic", "A diffuse surface under a clear coat, smooth or rough.")
        .def("__init__", &make_plastic, given("albedo"), given("roughness"), given("index") = 1.5,
             given("specular") = nb::make_tuple(1.0, 1.0, 1.0),
             R"(An albedo of 1 loses no light.

Args:
    albedo: of what enters the coat, linear red, green, blue in [0, 1], or a texture.
    roughness: of the coat, as that of RoughConductor.
    index: of refraction of the coat, at least 1.
    specular: multiplies what the coat reflects, red, green, blue in [0, 1], or a texture.)");
}

}  // namespace limn::python
