// Lights as they may be in a light table.
#pragma once

#include <array>

#include "flat/lights.h"
#include "support/random_geometry.h"

namespace limn::test {

// Returns a light that is a surface.
inline flat::Light random_light(Random& random) {
    const double size = random.log_uniform(1e-3, 30);
    const std::array shapes{flat::PlanarShape::triangle, flat::PlanarShape::parallelogram, flat::PlanarShape::rectangle,
                            flat::PlanarShape::part};
    const std::size_t kind = random.index(5);
    if (kind == shapes.size()) {
        flat::SphereLight sphere;
        sphere.center = Point3{} + random.in_cube(3);
        sphere.radius = size;
        return sphere;
    }
    flat::PlanarLight light;
    light.shape = shapes[kind];
    light.corner = Point3{} + random.in_cube(3);
    light.primitive = PrimitiveKind::quad;
    if (light.shape == flat::PlanarShape::triangle) light.primitive = PrimitiveKind::triangle, light.share = 0.5;
    if (light.shape == flat::PlanarShape::part) light.primitive = PrimitiveKind::disk, light.share = kPi / 4;
    light.edge_u = size * random.unit();
    light.edge_v = size * random.unit();
    if (light.shape == flat::PlanarShape::rectangle || light.shape == flat::PlanarShape::part)
        light.edge_v = random.log_uniform(0.1, 10) * cross(light.edge_u, random.unit());
    const double error = random.uniform(0, 1e-13);
    light.position_error = {error, error, error};
    return light;
}

// Returns a surface or a light that is none, near or distant. `environment` is one of them.
inline flat::Light random_light(Random& random, const flat::EnvironmentLight& environment) {
    const Point3 position = Point3{} + random.in_cube(3);
    const Vec3 direction = random.unit();
    switch (random.index(8)) {
        case 0: return flat::PointLight{{position, {}}};
        case 1: return flat::SpotLight{{position, {}}, direction};
        case 2: return flat::DirectionalLight{direction, {}};
        case 3: return flat::SunLight{direction, {}, random.log_uniform(1e-6, 1)};
        case 4: return environment;
        default: return random_light(random);
    }
}

}  // namespace limn::test
