// The innermost part of a render: the samples of a tile.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "flat/scene.h"
#include "limn/render/film.h"
#include "limn/scene/camera.h"
#include "render/path.h"

namespace limn::transport {

class TileRenderer {
public:
    // `info` has the settings.
    TileRenderer(const flat::Scene& scene, const FilmInfo& info);

    // Traces what a tile of the film lacks to its plan; adds it to the film with `mutex` held, so that at any moment
    // the film counts just what was traced for the samples that it has, and to `samples`. Several threads may render
    // different tiles.
    void render(Film& film, std::uint32_t tile, std::mutex& mutex, std::atomic<std::uint64_t>& samples) const;

private:
    using Pixels = std::vector<std::pair<int, int>>;
    void set_camera_rays(std::span<Path> paths, const Pixels& pixels) const;

    const flat::Scene& scene_;
    const FilmInfo& info_;
    const CameraRays camera_;
    const bool has_lens_or_motion_;
    mutable tbb::enumerable_thread_specific<PathTracer> tracers_;
};

}  // namespace limn::transport
