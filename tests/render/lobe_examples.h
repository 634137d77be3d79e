// Materials of every lobe, for the tests that compare compiled materials with described ones.
#pragma once

#include "limn/limn.h"
#include "support/pictures.h"

namespace limn::test {

/// Returns at least one material of each lobe. tests/architecture demands one of each class that defines a lobe.
inline std::vector<MaterialPtr> lobe_examples() {
    const auto checker = std::make_shared<Checker>(0.7, Color{0.9, 0.6, 0.3}, Color{0.1, 0.2, 0.3});
    const Color color{0.75, 0.5, 0.125}, other{0.2, 0.9, 1};
    const Roughness uneven{.2, .9};
    return {std::make_shared<Lambertian>(color),
            std::make_shared<Lambertian>(checker),
            std::make_shared<Isotropic>(color),
            std::make_shared<Isotropic>(checker),
            std::make_shared<Metal>(color, 0),
            std::make_shared<Metal>(checker, 0.4),
            std::make_shared<Metal>(checker, 1),
            std::make_shared<Metal>(other, 0.1),
            std::make_shared<Dielectric>(1.5),
            std::make_shared<Dielectric>(0.7, Fresnel::schlick),
            std::make_shared<Dielectric>(1),
            std::make_shared<OrenNayar>(checker, 0.3),
            std::make_shared<OrenNayar>(other, 1),
            std::make_shared<RoughConductor>(checker, 0, Color{.2, .7, 1}),
            std::make_shared<RoughConductor>(checker, 0.5),
            std::make_shared<RoughConductor>(Color{1, .5, 0}, uneven, Color{.2, .7, 1}),
            std::make_shared<RoughDielectric>(1.5, 0.4),
            std::make_shared<RoughDielectric>(0.7, uneven),
            std::make_shared<Plastic>(color, 0.1),
            std::make_shared<Plastic>(checker, 0, 1.3),
            std::make_shared<Plastic>(checker, uneven, 1.5, checker),
            std::make_shared<MetallicRoughness>(color, 0.9, 0.7, 1.3),
            std::make_shared<MetallicRoughness>(checker, checker)};
}

}  // namespace limn::test
