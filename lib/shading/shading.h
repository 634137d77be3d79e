// Materials and textures of the compiled scene at one surface.
#pragma once

#include "bsdf/lobe.h"
#include "flat/scene.h"
#include "limn/math/surface.h"
#include "shading/lights.h"

namespace limn::shade {

Color texture_value(const flat::Scene& scene, TextureId id, const Surface& s);

// How the material scatters; null: it absorbs all light.
const bsdf::Lobe* lobe_of(const flat::Scene& scene, const MaterialRef& material);

// Whether the material's value is zero for all directions.
bool is_specular(const flat::Scene& scene, const MaterialRef& material);

// False where the surface does not emit.
bool can_emit(const flat::Scene& scene, const MaterialRef& material);
Color emitted(const flat::Scene& scene, const Surface& s);

// Of a direction of any length. \pre there is an environment
Color environment_radiance(const flat::Scene& scene, const Vec3& direction);

// Of a sun's disc.
Color sun_radiance(const LightRecord& sun);
// Whether the disc covers a direction of any length.
bool sun_covers(const LightRecord& sun, const Vec3& direction);

// As a normal map bends it. \param incoming direction of the ray that came here
Normal3 shading_normal(const flat::Scene& scene, const Surface& s, const Vec3& incoming);

// How much of the light it stops, by the opacity of its material.
double opacity(const flat::Scene& scene, const Surface& s);

// A sample of a light.
Uv texture_coordinates_of(const flat::Scene& scene, const lights::LightSamples& samples, std::size_t i);
Color radiance_of(const flat::Scene& scene, const lights::LightSamples& samples, std::size_t i);

// Sets what the lobe needs of vertex i. \param incoming direction of the ray that came here, of any length
// \pre lobe_of(scene, s.material)
void set_vertex(const flat::Scene& scene, const Surface& s, const Vec3& incoming, bsdf::Vertices& vertices,
                std::size_t i);

}  // namespace limn::shade
