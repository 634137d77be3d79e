#include "render/tile_renderer.h"

#include <algorithm>

#include "render/sampler.h"

namespace limn::transport {

namespace {

// The camera's numbers: those of the first group.
void draw_first(std::span<Path> paths, std::size_t dimensions, sampling::Row* numbers) {
    std::uint64_t base[sampling::kShaded] = {};
    std::uint32_t index[sampling::kShaded] = {}, group[sampling::kShaded] = {};
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const Sampler& sampler = paths[i].sampler;
        base[i] = sampler.base(), index[i] = sampler.index();
        if (sampler.kind() == SamplerKind::sobol) continue;
        const auto drawn = sampler.numbers_of(0);
        for (std::size_t d = 0; d < dimensions; ++d) numbers[d][i] = drawn[d];
    }
    if (paths[0].sampler.kind() == SamplerKind::sobol)
        sobol::draw({paths.size(), base, index, group}, dimensions, numbers);
}

}  // namespace

TileRenderer::TileRenderer(const flat::Scene& scene, const FilmInfo& info)
    : scene_(scene),
      info_(info),
      camera_(info.camera, info.width, info.height),
      has_lens_or_motion_(info.camera.aperture_angle > 0 ||
                          (scene.kinds & flat::bit(PrimitiveKind::moving_sphere)) != 0 ||
                          scene.features.moving_instances || scene.features.foreign_shapes),
      tracers_([this] { return PathTracer(scene_, info_.max_depth, info_.estimator); }) {}

void TileRenderer::render(Film& film, std::uint32_t tile, std::mutex& mutex,
                          std::atomic<std::uint64_t>& samples) const {
    PathTracer& tracer = tracers_.local();
    std::vector<Path> paths;
    Pixels pixels;
    Film::Counts before{tracer.rays(), tracer.unusable_rays(), 0};
    const auto flush = [&] {
        set_camera_rays(paths, pixels);
        tracer.trace(paths);
        Film::Counts counts{tracer.rays() - before.rays, tracer.unusable_rays() - before.unusable_rays, 0};
        before += counts;
        {
            const std::scoped_lock lock(mutex);
            for (std::size_t i = 0; i < paths.size(); ++i)
                counts.nonfinite += film.add(pixels[i].first, pixels[i].second, paths[i].radiance) ? 0 : 1;
            film.count(tile, counts);
        }
        samples += paths.size();
        paths.clear(), pixels.clear();
    };
    const Film::Tile t = film.tile(tile);
    for (int y = t.top; y < t.bottom; ++y)
        for (int x = t.left; x < t.right; ++x)
            for (auto i = film.samples(x, y), n = film.plan().wanted(x, y, film.place(x, y)); i < n; ++i) {
                paths.push_back({Sampler(info_.seed, film.index(x, y), i, info_.sampler)});
                pixels.emplace_back(x, y);
                if (paths.size() == sampling::kBatch) flush();
            }
    if (!paths.empty()) flush();
}

void TileRenderer::set_camera_rays(std::span<Path> paths, const Pixels& pixels) const {
    // In the pixel, on the lens, in time.
    const std::size_t dimensions = has_lens_or_motion_ ? 5 : 2;
    sampling::Row numbers[5] = {};
    for (std::size_t first = 0; first < paths.size(); first += sampling::kShaded) {
        const std::span some = paths.subspan(first, std::min(sampling::kShaded, paths.size() - first));
        draw_first(some, dimensions, numbers);
        for (std::size_t i = 0; i < some.size(); ++i) {
            const auto [x, y] = pixels[first + i];
            const double dx = info_.antialias ? numbers[0][i] : 0.5;
            const double dy = info_.antialias ? numbers[1][i] : 0.5;
            some[i].ray = camera_.ray(x + dx, y + dy, numbers[2][i], numbers[3][i], numbers[4][i]);
        }
    }
}

}  // namespace limn::transport
