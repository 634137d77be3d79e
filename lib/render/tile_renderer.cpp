#include "render/tile_renderer.h"

#include <algorithm>

#include "render/sampler.h"

namespace limn::transport {

TileRenderer::TileRenderer(const flat::Scene& scene, const FilmInfo& info)
    : scene_(scene),
      info_(info),
      camera_(scene, info),
      tracers_([this] { return PathTracer(scene_, info_.max_depth, info_.estimator, info_.transparent); }) {}

void TileRenderer::render(Film& film, std::uint32_t tile, std::mutex& mutex,
                          std::atomic<std::uint64_t>& samples) const {
    PathTracer& tracer = tracers_.local();
    std::vector<Path> paths;
    Pixels pixels;
    Film::Counts before{tracer.rays(), tracer.unusable_rays(), 0};
    const auto flush = [&] {
        camera_.make_rays(paths, pixels, tracer.camera_rays());
        tracer.trace(paths);
        Film::Counts counts{tracer.rays() - before.rays, tracer.unusable_rays() - before.unusable_rays, 0};
        before += counts;
        {
            const std::scoped_lock lock(mutex);
            for (std::size_t i = 0; i < paths.size(); ++i)
                counts.nonfinite +=
                    film.add(pixels[i].first, pixels[i].second, paths[i].radiance, paths[i].clear) ? 0 : 1;
            film.count(tile, counts);
        }
        samples += paths.size();
        paths.clear();
        pixels.clear();
    };
    const Film::Tile t = film.tile(tile);
    for (int y = t.top; y < t.bottom; ++y)
        for (int x = t.left; x < t.right; ++x)
            for (auto i = film.samples(x, y), n = film.plan().wanted(x, y, film.place(x, y)); i < n; ++i) {
                paths.push_back(camera_.path(x, y, i));
                pixels.emplace_back(x, y);
                if (paths.size() == sampling::kBatch) flush();
            }
    if (!paths.empty()) flush();
}

}  // namespace limn::transport
