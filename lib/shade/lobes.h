// Vertices of many paths side by side, on materials that scatter by a lobe that needs no more than normals and a
// colour. The same as lib/bsdf and lib/render say one by one, but for rounding. What a path gets does not depend on the
// others.
#pragma once

#include <cstddef>
#include <cstdint>

#include "flat/lights.h"
#include "limn/core/color.h"
#include "limn/core/vec.h"
#include "sampling/sobol_lanes.h"

namespace limn::shade {

using sampling::kShaded, sampling::Lane;

struct Lanes3 {
    alignas(64) Lane x = {};
    Lane y = {}, z = {};

    // Of a point, direction or normal.
    template <class Three>
    void set(std::size_t i, const Three& v) {
        x[i] = v.x, y[i] = v.y, z[i] = v.z;
    }
    void set(std::size_t i, const Color& c) { x[i] = c.r, y[i] = c.g, z[i] = c.b; }
    template <class Three>
    Three get(std::size_t i) const {
        return {x[i], y[i], z[i]};
    }
};

enum class Lobe { lambertian, isotropic, dielectric };
inline constexpr Lobe kLobes[] = {Lobe::lambertian, Lobe::isotropic, Lobe::dielectric};

struct VertexLanes {
    std::size_t count = 0;
    // As in Surface. In media normals are zero.
    Lanes3 position, position_error, normal, shading_normal;
    Lanes3 albedo;
    Lane numbers[3] = {};
    // Of glass: back along the path, unit; the index of refraction of the far side over that of the near one; and 1
    // where Fresnel's equations are meant, 0 for Schlick's approximation.
    Lanes3 out;
    Lane eta = {}, exact_fresnel = {};
    // For sample_lights: which one, its radiance, and with which probability it was chosen; 0: none.
    const flat::Light* light[kShaded] = {};
    Lanes3 emission;
    Lane probability = {};

    // Answers of scatter: where the next segment goes, by bit whether there is one, and its density per solid angle; 0
    // where it is specular.
    std::uint32_t scattered = 0;
    Lanes3 origin, direction;
    Lane pdf = {};
    // Answers of sample_lights, by bit: light arrives if nothing is on the way from an origin along its direction; or
    // this vertex and light have to be asked one by one.
    std::uint32_t lit = 0, open = 0;
    Lanes3 arriving;  // f |cos| * emission / pdf, weighed against finding it by scattering
    Lanes3 shadow_origin, shadow_direction;
};

// A direction in which each vertex scatters, by numbers[0] and [1]. Its weight is the albedo, of glass 1.
void scatter(Lobe lobe, VertexLanes& vertices);

// A point on each vertex's light, by numbers[1] and [2]. Not for glass, which no light but the specular one reaches.
void sample_lights(Lobe lobe, VertexLanes& vertices);

}  // namespace limn::shade
