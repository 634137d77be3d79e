/// \file
/// What the camera meets first, for compositing and denoising.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "limn/image/image.h"
#include "limn/query/compiled_scene.h"
#include "limn/render/settings.h"
#include "limn/scene/camera.h"

namespace limn {

/// Of each pixel, row by row from the top left one, the first surface that the camera sees. Boundaries of media, and
/// shapes that say they bend no light, are looked through, and so are the holes of an AlphaMask: the surface is the
/// one by which half of the light is stopped.
///
/// Albedo and normal are means over the camera rays of the pixel's first kRays samples, so that edges, a lens and
/// motion look as they do in the picture: without these three they are the surface's own, free of noise. All else is
/// that of the ray through the middle of the pixel, of the lens and of the shutter.
struct FirstHits {
    static constexpr int kRays = 16;  ///< a pixel

    Image albedo;              ///< CompiledScene::albedo; black where there is nothing
    Image normal;              ///< Surface::shading_normal, as a NormalMap bends it; (0, 0, 0) where there is nothing
    Image position;            ///< in world units; (0, 0, 0) where there is nothing
    std::vector<float> depth;  ///< from the ray's origin, in world units; infinite where there is nothing
    std::vector<std::int64_t> object;     ///< RayHit::object; -1 where there is nothing
    std::vector<std::int64_t> primitive;  ///< RayHit::element; -1 where there is nothing

    /// As channels of an EXR: of "albedo" albedo.R, albedo.G and albedo.B, of "normal" and "position" .X, .Y and .Z, of
    /// the others one of that name. Numbers of objects and primitives are float, exact up to 16777216.
    /// \throws ArgumentError for another name
    std::vector<ImageLayer> layers(std::string_view name) const;
    static bool knows(std::string_view name);  ///< whether `layers` does
};

/// Traces camera rays, and nothing behind what they hit. Of the settings those count that say which pixels there are,
/// and which rays: size, crop, seed, sampler, antialias, threads. \throws what `render` throws for settings and camera
FirstHits first_hits(const CompiledScene& scene, const Camera& camera, const RenderSettings& settings = {});

}  // namespace limn
