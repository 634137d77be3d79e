// Camera rays: the ones of a pixel's samples, and the one through its middle.
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

class CameraSamples {
public:
    // `info` has the settings, and outlives this.
    CameraSamples(const flat::Scene& scene, const FilmInfo& info);

    // The path of a sample, still without its ray.
    Path path(int x, int y, std::uint32_t sample) const;
    // The rays of paths, which belong to these pixels, become the first rows. \pre there are kBatch at most
    void make_rays(std::span<const Path> paths, const Pixels& pixels, shade::Segments& rays) const;
    // Through the middle of a pixel, of the lens and of the shutter.
    Ray middle_ray(int x, int y) const;

private:
    const FilmInfo& info_;
    const CameraRays camera_;
    const PixelBounds window_;
    const bool has_lens_or_motion_;
};

}  // namespace limn::transport
