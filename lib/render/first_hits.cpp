#include "limn/render/first_hits.h"

#include <limits>
#include <memory>
#include <optional>

#include "limn/math/error.h"
#include "math/parallel.h"
#include "math/spawn.h"
#include "query/results.h"
#include "query/surface_at.h"
#include "render/camera_samples.h"
#include "render/holes.h"
#include "render/job_info.h"
#include "shading/albedo.h"
#include "shading/shading.h"
#include "trace/traverse.h"

namespace limn {

namespace {

using transport::CameraSamples;

// A hit of a camera ray and its surface.
struct SurfaceHit {
    RayHit hit;  // hit.t is measured from the last index-matched surface that the ray passed, if there is one
    Surface surface;
};

// Returns the first surface at which the ray ends. The ray passes index-matched surfaces. It passes surfaces with holes
// as long as they stop less than half of the light together.
std::optional<SurfaceHit> first_surface(const CompiledScene& scene, Ray ray) {
    transport::Holes holes;
    double half = 0.5;
    while (is_usable(ray)) {
        const trace::Hit hit = holes.first_stop(scene.flat(), ray, trace::closest_hit(scene.flat(), ray), half);
        if (hit.primitive == flat::RawHit::kMiss) return std::nullopt;
        const query::SurfaceHit met = query::surface_at(scene.flat(), ray, hit);
        if (!met.index_matched) return SurfaceHit{query::complete(scene.flat(), hit), met.surface};
        ray = leave(met.surface, ray.direction, ray.time);
    }
    return std::nullopt;
}

// Finds the first hits of the pixels, row by row. Several threads may work on different rows.
class Rows {
public:
    Rows(const CompiledScene& scene, const FilmInfo& info, FirstHits& hits)
        : scene_(scene), samples_(scene.flat(), info), hits_(hits) {}

    // Sets all pixels of row y in the FirstHits.
    void find(int y) const {
        transport::Pixels pixels(FirstHits::kRays);
        std::vector<transport::Path> paths;
        const auto rays = std::make_unique<shade::Segments>();
        for (int x = 0; x < hits_.albedo.width(); ++x) {
            find_middle(x, y);
            paths.clear();
            for (std::uint32_t i = 0; i < FirstHits::kRays; ++i) paths.push_back(samples_.path(x, y, i));
            pixels.assign(FirstHits::kRays, {x, y});
            samples_.make_rays(paths, pixels, *rays);
            find_means(x, y, *rays);
        }
    }

private:
    // Sets what the ray through the middle of a pixel finds: position, depth, object and primitive.
    void find_middle(int x, int y) const {
        const Ray ray = samples_.middle_ray(x, y);
        const std::optional<SurfaceHit> found = first_surface(scene_, ray);
        if (!found) return;
        const std::size_t i =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(hits_.albedo.width()) + static_cast<std::size_t>(x);
        const Point3& p = found->surface.position;
        hits_.position.set(x, y, {p.x, p.y, p.z});
        hits_.depth[i] = static_cast<float>(length(p - ray.origin));
        hits_.object[i] = static_cast<std::int64_t>(found->hit.object);
        hits_.primitive[i] = static_cast<std::int64_t>(found->hit.element);
    }

    // Sets what is a mean over the first kRays rays of a pixel: albedo and normal. Rays that hit nothing count as 0.
    void find_means(int x, int y, const shade::Segments& rays) const {
        Color albedo;
        Vec3 normal;
        for (std::size_t i = 0; i < FirstHits::kRays; ++i) {
            const Ray ray = rays.ray(i);
            const std::optional<SurfaceHit> found = first_surface(scene_, ray);
            if (!found) continue;
            albedo += shade::albedo(scene_.flat(), found->surface);
            normal = normal + Vec3(shade::shading_normal(scene_.flat(), found->surface, ray.direction));
        }
        hits_.albedo.set(x, y, albedo / FirstHits::kRays);
        hits_.normal.set(x, y, Color{normal.x, normal.y, normal.z} / FirstHits::kRays);
    }

    const CompiledScene& scene_;
    const CameraSamples samples_;
    FirstHits& hits_;
};

// Returns the three channels of an image as layers. Their names are `name`, a dot and one letter of `parts`.
std::vector<ImageLayer> layers_of(const Image& image, std::string_view name, std::string_view parts) {
    std::vector<ImageLayer> layers;
    for (std::size_t c = 0; c < 3; ++c) {
        ImageLayer& layer = layers.emplace_back(ImageLayer{std::string(name) + "." + parts[c], {}});
        for (std::size_t i = c; i < image.values().size(); i += 3) layer.values.push_back(image.values()[i]);
    }
    return layers;
}

// Returns one layer with a value for each pixel.
template <class T>
std::vector<ImageLayer> layers_of(const std::vector<T>& values, std::string_view name) {
    std::vector<float> floats(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) floats[i] = static_cast<float>(values[i]);
    return {{std::string(name), std::move(floats)}};
}

}  // namespace

FirstHits first_hits(const CompiledScene& scene, const Camera& camera, const RenderSettings& settings) {
    const FilmInfo info = transport::film_info(scene, camera, settings);
    const int width = info.window().width(), height = info.window().height();
    FirstHits hits{Image(width, height), Image(width, height), Image(width, height), {}, {}, {}};
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    hits.depth.assign(pixels, std::numeric_limits<float>::infinity());
    hits.object.assign(pixels, -1);
    hits.primitive.assign(pixels, -1);
    with_threads(settings.threads, [&] {
        const Rows rows(scene, info, hits);
        for_each_row(height, [&](int y) { rows.find(y); });
    });
    return hits;
}

bool FirstHits::knows(std::string_view name) {
    return name == "albedo" || name == "normal" || name == "position" || name == "depth" || name == "object" ||
           name == "primitive";
}

std::vector<ImageLayer> FirstHits::layers(std::string_view name) const {
    if (name == "albedo") return layers_of(albedo, name, "RGB");
    if (name == "normal") return layers_of(normal, name, "XYZ");
    if (name == "position") return layers_of(position, name, "XYZ");
    if (name == "depth") return layers_of(depth, name);
    if (name == "object") return layers_of(object, name);
    if (name == "primitive") return layers_of(primitive, name);
    throw ArgumentError("FirstHits::layers: there is no '" + std::string(name) + "'");
}

}  // namespace limn
