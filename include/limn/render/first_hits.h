/// \file
/// The first surface in each pixel, for compositing and denoising.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "limn/image/image.h"
#include "limn/query/compiled_scene.h"
#include "limn/render/settings.h"
#include "limn/scene/camera.h"

namespace limn {

/// The first surface that the camera sees in each pixel. All tables go row by row from the top left pixel.
///
/// - Boundaries of media, and shapes that say that they are index-matched, don't count as surfaces.
/// - Surfaces with an AlphaMask are skipped until half of the light is stopped.
/// - Albedo and normal are means over the camera rays of the pixel's first kRays samples. They show edges, depth of
///   field and motion blur as the picture does.
/// - Position, depth, object and primitive come from a single ray, through the middle of the pixel, the lens and the
///   shutter.
struct FirstHits {
    static constexpr int kRays = 16;  ///< number of rays per pixel for albedo and normal

    Image albedo;              ///< CompiledScene::albedo; black if there is no surface
    Image normal;              ///< shading normal in world space, bent by a NormalMap; zero if there is no surface
    Image position;            ///< point in world space; zero if there is no surface
    std::vector<float> depth;  ///< distance from the ray's origin, in world units; infinite if there is no surface
    std::vector<std::int64_t> object;     ///< RayHit::object; -1 if there is no surface
    std::vector<std::int64_t> primitive;  ///< RayHit::element; -1 if there is no surface

    /// Returns the values of a member as channels of an EXR. "albedo" gives albedo.R, albedo.G and albedo.B. "normal"
    /// and "position" give three channels that end in .X, .Y and .Z. "depth", "object" and "primitive" give one channel
    /// of that name. Numbers of objects and primitives become float, which is exact up to 16777216.
    /// \throws ArgumentError for another name
    std::vector<ImageLayer> layers(std::string_view name) const;
    static bool knows(std::string_view name);  ///< returns true if `layers` accepts the name
};

/// Traces the camera rays up to the first surface. Of the settings only width, height, crop, seed, sampler, antialias
/// and threads matter.
/// \throws ArgumentError or Error as `render` does
FirstHits first_hits(const CompiledScene& scene, const Camera& camera, const RenderSettings& settings = {});

}  // namespace limn
