// The samples of the path tracer beside those of the reference, lib/render/li.h.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "limn/query/compiled_scene.h"
#include "render/camera_samples.h"
#include "render/job_info.h"
#include "render/li.h"

namespace limn::test {

// The number of compared paths, and of those whose samples are not the same within 1e-12.
struct ComparedPaths {
    int paths = 0, differing = 0;
    double mean = 0;  // of the radiance by the reference
};

inline bool nearly_same(const transport::Path& a, const transport::Path& reference) {
    const Color& r = reference.radiance;
    const Color difference = a.radiance - r;
    const double largest = std::max({std::abs(difference.r), std::abs(difference.g), std::abs(difference.b)});
    return largest <= 1e-12 * max_component(r) && std::abs(a.clear - reference.clear) <= 1e-12 * reference.clear;
}

// Compares all samples of a picture. \pre settings.width <= sampling::kBatch
inline ComparedPaths compare_paths(const CompiledScene& scene, const Camera& camera, const RenderSettings& settings) {
    const FilmInfo info = transport::film_info(scene, camera, settings);
    const transport::CameraSamples camera_samples(scene.flat(), info);
    const transport::PathSettings path_settings(scene.flat(), info.max_depth, info.estimator, info.transparent);
    transport::PathTracer tracer(scene.flat(), info.max_depth, info.estimator, info.transparent);
    ComparedPaths compared;
    for (int row = 0; row < settings.height * settings.samples_per_pixel; ++row) {
        // One sample of each pixel of a row of the picture.
        const int y = row / settings.samples_per_pixel;
        const auto sample = static_cast<std::uint32_t>(row % settings.samples_per_pixel);
        std::vector<transport::Path> paths;
        transport::Pixels pixels;
        for (int x = 0; x < settings.width; ++x) {
            paths.push_back(camera_samples.path(x, y, sample));
            pixels.emplace_back(x, y);
        }
        camera_samples.make_rays(paths, pixels, tracer.camera_rays());
        std::vector<transport::Path> references;
        for (std::size_t i = 0; i < paths.size(); ++i)
            references.push_back(transport::li(path_settings, tracer.camera_rays().ray(i), paths[i].sampler));
        tracer.trace(paths);
        for (std::size_t i = 0; i < paths.size(); ++i) {
            ++compared.paths;
            compared.differing += nearly_same(paths[i], references[i]) ? 0 : 1;
            compared.mean += luminance(references[i].radiance);
        }
    }
    compared.mean /= compared.paths;
    return compared;
}

}  // namespace limn::test
