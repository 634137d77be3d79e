// How materials scatter, for many vertices of paths at a time. A material of limn's own states its lobe's formulas once
// (lib/scene/material), in terms of lobe-inl.h; those of user-defined materials are called one by one.
#pragma once

#include <cstdint>
#include <vector>

#include "limn/math/surface.h"
#include "limn/records/records.h"
#include "math/rows.h"

namespace limn::bsdf {

using sampling::kShaded, sampling::Row, sampling::Rows3;

struct UserDefined {
    Surface surface;
    const Material* object = nullptr;
    const MaterialThunks* thunks = nullptr;
};

// Vertices on materials of one lobe.
struct Vertices {
    std::size_t count = 0;
    // As in Surface. In media normals are zero.
    Rows3 position, position_error, normal, shading_normal;
    Row front_face = {};  // 1 or 0
    Rows3 incoming;       // the direction of the ray that came here, of any length
    // Of the material.
    Rows3 albedo;
    Row parameter = {}, exact_fresnel = {};  // 1: Fresnel::exact
    std::vector<UserDefined> user_defined;   // as many, where the lobe calls them
    // Of materials with details.
    Rows3 dp_du, second_texture;
    Row details[MaterialDetails::kNumbers] = {};
    const AlbedoTable* albedo_table[kShaded] = {};
    const AlbedoTable* coat_albedo_table[kShaded] = {};
    std::uint32_t folds = 0;  // bits of those whose shading normal a NormalMap bent, on a one-sided lobe

    // For sample: three uniform numbers. Of its results the weight is black where light is absorbed, and the pdf is 0
    // where the direction is specular.
    Row numbers[3] = {};
    Rows3 direction, weight;
    Row pdf = {};

    // Of value: f |cos|, and the density with which sample draws that direction.
    Rows3 value;
    Row value_pdf = {};
};

struct Lobe {
    bool one_sided;       // the value is zero wherever the directions are on different sides of the geometric surface
    std::size_t numbers;  // how many sample needs
    void (*sample)(Vertices&);
    void (*value)(Vertices&, const Rows3& in);
};

// A lobe's functions, to be called so. What it reflects below the surface around a bent normal is mirrored there.
void sample(const Lobe& lobe, Vertices& vertices);
void value(const Lobe& lobe, Vertices& vertices, const Rows3& in);

extern const Lobe kUserDefined;

}  // namespace limn::bsdf
