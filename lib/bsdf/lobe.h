// Lobes: the functions by which materials scatter. A lobe processes many vertices of paths at a time. The source of
// each of limn's own materials (lib/scene/material) defines its lobe, with formulas that are written in terms of
// lobe-inl.h. One lobe, kUserDefined, calls user-defined materials one by one.
#pragma once

#include <cstdint>
#include <vector>

#include "limn/math/surface.h"
#include "limn/records/records.h"
#include "math/rows.h"

namespace limn::bsdf {

using sampling::kShaded, sampling::Row, sampling::Rows3;

// A vertex on a user-defined material, and how the material is called.
struct UserDefined {
    Surface surface;
    const Material* object = nullptr;
    const MaterialThunks* thunks = nullptr;
};

// Vertices of paths on materials that have the same lobe.
struct Vertices {
    std::size_t count = 0;
    // The fields of Surface of the same names. In a medium the normals are zero.
    Rows3 position, position_error, normal, shading_normal;
    Row front_face = {};  // 1 or 0
    Rows3 incoming;       // direction of the ray that arrived at the vertex, of any length
    // The colour of MaterialRecord::albedo, and the first Lobe::parameters of MaterialRecord::parameters.
    Rows3 albedo;
    Row parameters[LobeParameters::kMost] = {};
    // The following are set only if Lobe::microfacets is true. `factors` is the colour of MaterialRecord::factors.
    Rows3 dp_du, factors;
    const AlbedoTable* albedo_table[kShaded] = {};
    const AlbedoTable* coat_albedo_table[kShaded] = {};
    // Set only if the lobe is kUserDefined. The front face and the fields of materials are then unspecified.
    std::vector<UserDefined> user_defined;
    // Bit i is set if vertex i has a tangent facet (bent_normal.h): its lobe is one-sided, and a NormalMap bends its
    // shading normal.
    std::uint32_t tangent_facets = 0;

    // Input of sample(): up to three uniform numbers in [0, 1) for each vertex.
    Row numbers[3] = {};
    // Results of sample(). The weight is black if the light is absorbed. The pdf is 0 if the direction is specular.
    Rows3 direction, weight;
    Row pdf = {};

    // Results of value(): f |cos|, and the pdf with which sample() draws the direction.
    Rows3 value;
    Row value_pdf = {};
};

// The functions of a lobe. They are called by the functions sample() and value() below.
struct Lobe {
    bool one_sided;              // true if the value is zero for directions on different sides of the geometric surface
    std::size_t numbers;         // how many uniform numbers `sample` uses
    bool microfacets = false;    // true if the lobe uses Vertices::dp_du, `factors` and the albedo tables
    std::size_t parameters = 0;  // how many of MaterialRecord::parameters the lobe uses
    void (*sample)(Vertices&);
    void (*value)(Vertices&, const Rows3& in);
};

// Calls Lobe::sample. If a vertex has a tangent facet, directions below the surface are mirrored there.
void sample(const Lobe& lobe, Vertices& vertices);
// Calls Lobe::value for the directions `in`. If a vertex has a tangent facet, the value includes light that it mirrors.
void value(const Lobe& lobe, Vertices& vertices, const Rows3& in);

// The lobe of user-defined materials.
extern const Lobe kUserDefined;

}  // namespace limn::bsdf
