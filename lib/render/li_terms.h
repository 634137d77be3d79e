// The terms of the sum that li() makes, in the order in which a path meets them.
#pragma once

#include <cstdint>

#include "limn/math/ray.h"
#include "limn/math/surface.h"
#include "render/equiangular.h"
#include "render/media.h"
#include "render/path_settings.h"
#include "render/sampler.h"
#include "shading/single.h"

namespace limn::transport {

// The random numbers of a segment. They are drawn before its hits are known.
struct SegmentNumbers {
    SegmentNumbers(const Sampler& sampler, std::uint32_t vertex);

    double depth;   // optical depth in scattering after which media scatter the path; exponential
    double medium;  // uniform: chooses the medium that does
    double hole;    // uniform: decides which of the surfaces with an opacity stop the path
};

// The vertex at which a segment begins, as multiple importance sampling must know it.
struct LastVertex {
    shade::Receiver receiver{};
    double scatter_pdf = 0;  // pdf of the direction of the segment; 0 if light sampling cannot draw that direction,
                             // because it is specular or a camera ray
    double pdf_ratio = 1;    // ratio of the pdf of drawing the vertex for light sampling to that for scattering
};

// Returns an estimate of the light that media scatter once into the ray, on its way from a light to the ray's origin.
// \param along how a point of the ray is drawn
Color single_scattering(const PathSettings& settings, const Ray& ray, const MediaAlongRay& media,
                        const Equiangular& along, const Sampler& sampler, std::uint32_t vertex);

// Returns the emission that the path has found by scattering, times its weight against light sampling at the last
// vertex. `primitive` and `position` are those of lights::LightHits.
Color weighted_emission(const PathSettings& settings, const LastVertex& last, const Color& emission,
                        std::uint64_t primitive, const Point3& position, double time);

// Returns the weighted emission of the background and of distant lights along a ray that leaves the scene.
Color distant_emission(const PathSettings& settings, const LastVertex& last, const Ray& ray);

// Returns an estimate of the light that arrives at x straight from lights and is scattered into direction wo, by a
// sample of one light. It is weighted against scattering.
// \param pdf_ratio the ratio of LastVertex, for x. The estimate is divided by it
Color direct_light(const PathSettings& settings, const Surface& x, const Vec3& wo, double time, const Random3& random,
                   double pdf_ratio);

}  // namespace limn::transport
