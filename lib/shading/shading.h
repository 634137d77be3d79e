// Materials and textures of the compiled scene at one surface.
#pragma once

#include "bsdf/lobe.h"
#include "flat/scene.h"
#include "limn/math/surface.h"
#include "shading/lights.h"

namespace limn::shade {

// Returns the value of a texture at a surface.
Color texture_value(const flat::Scene& scene, TextureId id, const Surface& s);

// Returns the lobe of a material, or null if the material absorbs all light.
const bsdf::Lobe* lobe_of(const flat::Scene& scene, const MaterialRef& material);

// Returns true if the material's value is zero for all directions.
bool is_specular(const flat::Scene& scene, const MaterialRef& material);

// Returns false if the material never emits.
bool can_emit(const flat::Scene& scene, const MaterialRef& material);
// Returns the radiance that a surface emits towards the viewer.
Color emitted(const flat::Scene& scene, const Surface& s);

// Returns the shading normal, bent by the normal map of the material if it has one. \param incoming direction of the
// ray that arrived at the surface, of any length
Normal3 shading_normal(const flat::Scene& scene, const Surface& s, const Vec3& incoming);

// Returns the share of the light that the surface stops, by the opacity of its material.
double opacity(const flat::Scene& scene, const Surface& s);

// Returns the texture coordinates of sample i. \pre its light is a surface
Uv texture_coordinates_of(const flat::Scene& scene, const lights::LightSamples& samples, std::size_t i);
// Returns the radiance of sample i towards the receiver.
Color radiance_of(const flat::Scene& scene, const lights::LightSamples& samples, std::size_t i);

// Sets the fields of vertex i that the lobe of its material uses. \param incoming direction of the ray that arrived at
// the surface, of any length \pre lobe_of(scene, s.material) is not null
void set_vertex(const flat::Scene& scene, const Surface& s, const Vec3& incoming, bsdf::Vertices& vertices,
                std::size_t i);

}  // namespace limn::shade
