// The camera rays of a render: one for each sample of a pixel, and one through the middle of each pixel.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "flat/scene.h"
#include "limn/render/film.h"
#include "limn/scene/camera.h"
#include "render/path.h"

namespace limn::transport {

using Pixels = std::vector<std::pair<int, int>>;  // column and row in the film

// Makes camera rays. Pixels are given by column x and row y in the film, not in the whole picture. Thread-safe.
class CameraSamples {
public:
    // `info` contains the render settings. It must outlive this object.
    CameraSamples(const flat::Scene& scene, const FilmInfo& info);

    // Returns the path of sample number `sample` of a pixel, with its sampler. Its camera ray is made by make_rays.
    Path path(int x, int y, std::uint32_t sample) const;
    // Writes the camera ray of paths[i] through pixel pixels[i] to row i of `rays`.
    // \pre paths.size() <= kBatch, pixels.size() >= paths.size(), all samplers are of one kind
    void make_rays(std::span<const Path> paths, const Pixels& pixels, shade::Segments& rays) const;
    // Returns the ray through the middle of the pixel and of the lens, at the middle of the shutter interval.
    Ray middle_ray(int x, int y) const;

private:
    const FilmInfo& info_;
    const CameraRays camera_;
    const PixelBounds window_;
    const bool has_lens_or_motion_;
};

}  // namespace limn::transport
