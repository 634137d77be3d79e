#include "render/job_info.h"

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "flat/scene.h"
#include "limn/math/error.h"
#include "math/system/checksum.h"
#include "render/film_file.h"

namespace limn::transport {

namespace {

constexpr int kMaxThreads = 1024;

void check(const CompiledScene& scene, const RenderSettings& s) {
    const auto require = [](bool holds, const char* what) {
        if (!holds) throw ArgumentError(std::string("render: ") + what);
    };
    require(s.width > 0 && s.height > 0 && s.width <= kMaxSide && s.height <= kMaxSide,
            "width and height must be in 1 to 1048576");
    require(s.samples_per_pixel > 0, "samples per pixel must be at least 1");
    require(s.max_depth > 0, "the depth limit must be at least 1");
    require(!s.error || is_target(*s.error), "the error asked for must be over 0 and finite");
    require(!s.time_limit || is_target(*s.time_limit), "the time limit must be over 0 and finite");
    require(s.max_samples_per_pixel > 0, "the most samples per pixel must be at least 1");
    require(s.threads >= 0 && s.threads <= kMaxThreads, "threads must be in 0 to 1024");
    require(s.shard.count == 1 || (!s.error && !s.time_limit),
            "a shard ends by its samples or by a plan alone: the error is that of the whole picture");
    if (scene.flat().unassigned > 0)
        throw Error("render: " + std::to_string(scene.flat().unassigned) + " shapes of the scene have no material");
}

// Returns the digest of the running program's file. Programs with different user-defined classes have different ones.
Hash128 program_digest() {
    static const Hash128 digest = [] {
        std::ifstream program("/proc/self/exe", std::ios::binary);
        std::vector<char> buffer(1 << 20);
        Checksum sum;
        while (program.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || program.gcount() > 0)
            sum.add(std::as_bytes(std::span(buffer).first(static_cast<std::size_t>(program.gcount()))));
        return sum.digest();
    }();
    return digest;
}

}  // namespace

FilmInfo film_info(const CompiledScene& scene, const Camera& camera, const RenderSettings& settings) {
    check(scene, settings);
    FilmInfo info = {.scene = scene.name(),
                     .features = scene.features(),
                     .scene_digest = scene.digest(),
                     .program = scene.has_untagged() ? program_digest() : Hash128{},
                     .camera = camera,
                     .width = settings.width,
                     .height = settings.height,
                     .max_depth = settings.max_depth,
                     .seed = settings.seed,
                     .antialias = settings.antialias,
                     .estimator = settings.estimator,
                     .sampler = settings.sampler,
                     .uniform = settings.uniform,
                     .crop = settings.crop,
                     .transparent = settings.transparent,
                     .shard = settings.shard};
    if (!is_window(info)) throw ArgumentError("render: the crop window must be inside the picture and not empty");
    return info;
}

}  // namespace limn::transport
