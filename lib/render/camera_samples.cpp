#include "render/camera_samples.h"

#include <algorithm>

#include "render/sampler.h"
#include "scene/camera_rays.h"

namespace limn::transport {

namespace {

// Draws the first `dimensions` numbers of group 0, which is the camera's, for each path. \pre at most kShaded paths
void draw_first(std::span<const Path> paths, std::size_t dimensions, sampling::Row* numbers) {
    std::uint64_t base[sampling::kShaded] = {};
    std::uint32_t index[sampling::kShaded] = {}, group[sampling::kShaded] = {};
    for (std::size_t i = 0; i < paths.size(); ++i) {
        base[i] = paths[i].sampler.base();
        index[i] = paths[i].sampler.index();
    }
    const auto sampler_at = [&](std::size_t i) -> const Sampler& { return paths[i].sampler; };
    draw_numbers({paths.size(), base, index, group}, dimensions, sampler_at, numbers);
}

}  // namespace

CameraSamples::CameraSamples(const flat::Scene& scene, const FilmInfo& info)
    : info_(info),
      camera_(info.camera, info.width, info.height),
      window_(info.window()),
      has_lens_or_motion_(info.camera.aperture_angle > 0 ||
                          (scene.kinds & flat::bit(PrimitiveKind::moving_sphere)) != 0 ||
                          scene.features.moving_instances || scene.features.user_defined_shapes) {}

Path CameraSamples::path(int x, int y, std::uint32_t sample) const {
    // The sampler gets the pixel's number in the whole picture, so that a crop window does not change the samples.
    const auto column = static_cast<std::uint64_t>(window_.left + x), row = static_cast<std::uint64_t>(window_.top + y);
    const std::uint64_t pixel = row * static_cast<std::uint64_t>(info_.width) + column;
    return {Sampler(info_.seed, pixel, sample, info_.sampler)};
}

void CameraSamples::make_rays(std::span<const Path> paths, const Pixels& pixels, shade::Segments& rays) const {
    // Dimensions 0 and 1 are the position in the pixel, 2 and 3 the position on the lens, 4 is the time.
    const std::size_t dimensions = has_lens_or_motion_ ? 5 : 2;
    sampling::Row numbers[5] = {};
    for (std::size_t first = 0; first < paths.size(); first += sampling::kShaded) {
        const std::span some = paths.subspan(first, std::min(sampling::kShaded, paths.size() - first));
        draw_first(some, dimensions, numbers);
        // Turn the first two numbers into coordinates in the whole picture, in pixels.
        for (std::size_t i = 0; i < some.size(); ++i) {
            const auto [x, y] = pixels[first + i];
            numbers[0][i] = window_.left + x + (info_.antialias ? numbers[0][i] : 0.5);
            numbers[1][i] = window_.top + y + (info_.antialias ? numbers[1][i] : 0.5);
        }
        auto &from = rays.origin, &to = rays.direction;
        camera::make_rays(camera_, {some.size(),
                                    {numbers[0], numbers[1], numbers[2], numbers[3], numbers[4]},
                                    {from.x + first, from.y + first, from.z + first},
                                    {to.x + first, to.y + first, to.z + first},
                                    rays.time + first});
    }
}

Ray CameraSamples::middle_ray(int x, int y) const {
    return camera_.ray(window_.left + x + 0.5, window_.top + y + 0.5, 0.5, 0.5, 0.5);
}

}  // namespace limn::transport
