// The innermost part of a render: the samples of a tile.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <atomic>
#include <cstdint>
#include <mutex>

#include "flat/scene.h"
#include "limn/render/film.h"
#include "render/camera_samples.h"
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
    const flat::Scene& scene_;
    const FilmInfo& info_;
    const CameraSamples camera_;
    mutable tbb::enumerable_thread_specific<PathTracer> tracers_;
};

}  // namespace limn::transport
