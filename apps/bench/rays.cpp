#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "bench/scenes.h"
#include "limn/core/frame.h"
#include "limn/core/warp.h"

namespace limn::bench {

namespace {

constexpr std::size_t kTile = 8;
constexpr int kMostPasses = 64;          // over the picture, to gather the rays of deep paths
constexpr double kOcclusionReach = 0.1;  // of the scene's diagonal

// Indices into ray_kinds(). Diffuse rays have one for each depth.
constexpr std::size_t kPrimary = 0, kDiffuse = 1, kOcclusion = 4, kShadow = 5;

struct Path {
    Ray ray;
    std::uint64_t number;         // seeds its random numbers
    std::optional<Surface> at{};  // where the ray before this one hit
};

// The k-th pixel of a tile in Z-order, so that any 4, 16 and 64 rays are a square.
std::pair<std::size_t, std::size_t> place_in_tile(std::size_t k) {
    return {(k & 1) | (k >> 1 & 2) | (k >> 2 & 4), (k >> 1 & 1) | (k >> 2 & 2) | (k >> 3 & 4)};
}

class Maker {
public:
    Maker(const Geometry& geometry, const CompiledScene& scene, std::size_t count)
        : scene_(scene),
          count_(count),
          box_(describe(geometry).bounds()),
          side_(static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count)) / kTile)) * kTile),
          camera_(geometry.camera.value_or(frame_box(box_)), static_cast<int>(side_), static_cast<int>(side_)),
          light_(to_float32(geometry.light.value_or(box_.center() + length(box_.diagonal()) * Vec3(-0.7, 1.1, 0.8)))),
          t_min_(to_float32(geometry.t_min)) {
        for (const std::string& kind : ray_kinds()) sets_.push_back({.name = kind, .rays = {}});
        sets_[kPrimary].coherent = true;
        sets_[kOcclusion].any = sets_[kShadow].any = true;
    }

    std::vector<RaySet> make() {
        for (int pass = 0; pass < kMostPasses && !is_full(); ++pass) {
            std::vector<Path> paths = primary_paths(pass);
            add(kPrimary, paths);
            follow(paths);
            if (paths.empty()) break;
            for (const Path& path : paths) add_occlusion_and_shadow(path);
            for (std::size_t kind = kDiffuse; kind < kOcclusion; ++kind) {
                for (Path& path : paths) path.ray = leave(*path.at, cosine_direction(path, 2 + 2 * kind));
                add(kind, paths);
                follow(paths);
            }
        }
        std::erase_if(sets_, [](const RaySet& set) { return set.rays.empty(); });
        return std::move(sets_);
    }

private:
    bool is_full() const {
        return std::ranges::all_of(sets_, [&](const RaySet& set) { return set.rays.size() == count_; });
    }

    void add(std::size_t kind, const Ray& ray) {
        if (sets_[kind].rays.size() < count_) sets_[kind].rays.push_back(ray);
    }
    void add(std::size_t kind, const std::vector<Path>& paths) {
        for (const Path& path : paths) add(kind, path.ray);
    }

    // One through each pixel, tile by tile.
    std::vector<Path> primary_paths(int pass) const {
        std::vector<Path> paths;
        const std::size_t tiles = side_ / kTile;
        for (std::size_t tile = 0; tile < tiles * tiles; ++tile) {
            for (std::size_t k = 0; k < kTile * kTile; ++k) {
                const auto [x, y] = place_in_tile(k);
                const std::uint64_t number = static_cast<std::uint64_t>(pass) * side_ * side_ + paths.size();
                Ray ray = camera_.ray(static_cast<double>(tile % tiles * kTile + x) + random(number, 0),
                                      static_cast<double>(tile / tiles * kTile + y) + random(number, 1), 0, 0, 0);
                ray.origin = to_float32(ray.origin);
                ray.direction = to_float32(normalize(ray.direction));
                paths.push_back({ray, number});
            }
        }
        return paths;
    }

    // Moves each path to where its ray hits. Paths that leave the scene end.
    void follow(std::vector<Path>& paths) const {
        tbb::parallel_for(std::size_t{0}, paths.size(), [&](std::size_t i) {
            const auto hit = scene_.closest_hit(paths[i].ray);
            paths[i].at = hit ? std::optional(scene_.surface_at(paths[i].ray, *hit)) : std::nullopt;
        });
        std::erase_if(paths, [](const Path& path) { return !path.at; });
    }

    void add_occlusion_and_shadow(const Path& path) {
        Ray ray = leave(*path.at, cosine_direction(path, 2));
        ray.t_max = to_float32(kOcclusionReach * length(box_.diagonal()));
        add(kOcclusion, ray);
        const Vec3 to_light = light_ - path.at->position;
        if (dot(Vec3(path.at->normal), to_light) <= 0) return;  // its own surface is in the way
        // The light is at t = 1. A smaller t_max keeps the surface that holds the light out of the way.
        ray = leave(*path.at, to_light);
        ray.t_max = 1 - 0x1p-10;
        add(kShadow, ray);
    }

    // `dimension` is the first of two random numbers.
    Vec3 cosine_direction(const Path& path, std::uint64_t dimension) const {
        const Vec3 local = sample_cosine_hemisphere(random(path.number, dimension), random(path.number, dimension + 1));
        return Frame(Vec3(path.at->normal)).to_world(local);
    }

    // spawn_ray leaves the surface in double. The largest error of rounding to float32 is added to that.
    Ray leave(const Surface& from, const Vec3& direction) const {
        Ray ray = from.spawn_ray(direction, 0);
        const Vec3 out = dot(direction, Vec3(from.normal)) < 0 ? -Vec3(from.normal) : Vec3(from.normal);
        const double largest = std::max({std::abs(ray.origin.x), std::abs(ray.origin.y), std::abs(ray.origin.z)});
        ray.origin = to_float32(ray.origin + largest * 0x1p-21 * out);
        ray.direction = to_float32(ray.direction);
        ray.t_min = t_min_;
        return ray;
    }

    static double random(std::uint64_t number, std::uint64_t dimension) { return random_number(1, number, dimension); }

    const CompiledScene& scene_;
    const std::size_t count_;
    const Box box_;
    const std::size_t side_;  // of the picture, in pixels
    const CameraRays camera_;
    const Point3 light_;
    const double t_min_;
    std::vector<RaySet> sets_;
};

}  // namespace

const std::vector<std::string>& ray_kinds() {
    static const std::vector<std::string> kinds{"primary", "diffuse1", "diffuse2", "diffuse3", "occlusion", "shadow"};
    return kinds;
}

std::vector<RaySet> make_rays(const Geometry& geometry, const CompiledScene& scene, std::size_t count) {
    return Maker(geometry, scene, count).make();
}

}  // namespace limn::bench
