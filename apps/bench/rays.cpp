#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "bench/scenes.h"
#include "limn/limn.h"

namespace limn::bench {
namespace {

constexpr std::size_t kTile = 8;           // width and height of a tile in pixels
constexpr std::uint64_t kMostPasses = 64;  // largest number of passes over the picture to gather enough rays
constexpr double kOcclusionReach = 0.1;    // t_max of occlusion rays over the diagonal of the scene

// Indices into ray_kinds(). Diffuse rays have the indices kDiffuse to kDiffuse + 2, one for each depth.
constexpr std::size_t kPrimary = 0, kDiffuse = 1, kOcclusion = 4, kShadow = 5;

struct Path {
    Ray ray;                      // the last ray
    std::uint64_t number;         // the index of the path's random numbers
    std::optional<Surface> at{};  // the hit of the last ray that follow() has traced
};

// Returns a path through each pixel, tile by tile.
std::vector<Path> primary_paths(const CameraRays& camera, std::size_t side, std::uint64_t pass) {
    std::vector<Path> paths;
    const std::size_t tiles = side / kTile;
    for (std::size_t tile = 0; tile < tiles * tiles; ++tile) {
        for (std::size_t k = 0; k < kTile * kTile; ++k) {
            // Find the k-th pixel of the tile in Z-order. Each aligned group of 4, 16 or 64 rays then covers a square.
            const std::size_t x = (k & 1) | (k >> 1 & 2) | (k >> 2 & 4), y = (k >> 1 & 1) | (k >> 2 & 2) | (k >> 3 & 4);
            const std::uint64_t number = pass * side * side + paths.size();
            const auto u = random_numbers(1, number);
            Ray ray = camera.ray(static_cast<double>(tile % tiles * kTile + x) + u(0),
                                 static_cast<double>(tile / tiles * kTile + y) + u(1), 0, 0, 0);
            ray.origin = to_float32(ray.origin);
            ray.direction = to_float32(normalize(ray.direction));
            paths.push_back({ray, number});
        }
    }
    return paths;
}

// Traces the last ray of each path and sets Path::at to its hit. Removes paths without a hit.
void follow(const CompiledScene& scene, std::vector<Path>& paths) {
    tbb::parallel_for(std::size_t{0}, paths.size(), [&](std::size_t i) {
        const auto hit = scene.closest_hit(paths[i].ray);
        paths[i].at = hit ? std::optional(scene.surface_at(paths[i].ray, *hit)) : std::nullopt;
    });
    std::erase_if(paths, [](const Path& path) { return !path.at; });
}

// Returns a direction with a pdf proportional to the cosine. Uses random numbers `dimension` and `dimension` + 1.
Vec3 cosine_direction(const Path& path, std::uint64_t dimension) {
    const auto u = random_numbers(1, path.number);
    return Frame(Vec3(path.at->normal)).to_world(sample_cosine_hemisphere(u(dimension), u(dimension + 1)));
}

// Returns a ray with float32 coordinates that leaves a surface. spawn_ray moves the origin off the surface by its error
// in double. This function moves it further by the largest error of rounding it to float32.
Ray leave(const Surface& from, const Vec3& direction, double t_min) {
    Ray ray = from.spawn_ray(direction, 0);
    const Vec3 out = dot(direction, Vec3(from.normal)) < 0 ? -Vec3(from.normal) : Vec3(from.normal);
    ray.origin = to_float32(ray.origin + max_abs(ray.origin) * 0x1p-21 * out);
    ray.direction = to_float32(ray.direction);
    ray.t_min = to_float32(t_min);
    return ray;
}

}  // namespace

const std::vector<std::string>& ray_kinds() {
    static const std::vector<std::string> kinds{"primary", "diffuse1", "diffuse2", "diffuse3", "occlusion", "shadow"};
    return kinds;
}

std::vector<RaySet> make_rays(const Geometry& geometry, const CompiledScene& scene, std::size_t count) {
    // Set up camera and light.
    const Box box = describe(geometry).bounds();
    const double size = length(box.diagonal());
    const Point3 light = to_float32(geometry.light.value_or(box.center() + size * Vec3(-0.7, 1.1, 0.8)));
    const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count)) / kTile)) * kTile;
    const CameraRays camera(geometry.camera.value_or(frame_box(box)), static_cast<int>(side), static_cast<int>(side));
    // Make an empty set for each kind.
    std::vector<RaySet> sets;
    for (const std::string& kind : ray_kinds()) sets.push_back({.name = kind, .rays = {}});
    sets[kPrimary].coherent = true;
    sets[kOcclusion].any = sets[kShadow].any = true;
    const auto add = [&](std::size_t kind, const Ray& ray) {
        if (sets[kind].rays.size() < count) sets[kind].rays.push_back(ray);
    };
    // Trace paths through all pixels, again and again until the sets are full.
    const auto is_full = [&](const RaySet& set) { return set.rays.size() == count; };
    for (std::uint64_t pass = 0; pass < kMostPasses && !std::ranges::all_of(sets, is_full); ++pass) {
        std::vector<Path> paths = primary_paths(camera, side, pass);
        for (const Path& path : paths) add(kPrimary, path.ray);
        follow(scene, paths);
        if (paths.empty()) break;
        // Make occlusion rays and shadow rays at the first hits.
        for (const Path& path : paths) {
            Ray ray = leave(*path.at, cosine_direction(path, 2), geometry.t_min);
            ray.t_max = to_float32(kOcclusionReach * size);
            add(kOcclusion, ray);
            const Vec3 to_light = light - path.at->position;
            if (dot(Vec3(path.at->normal), to_light) <= 0) continue;  // the surface faces away from the light
            // The light is at t = 1. t_max is smaller, so that the ray does not hit a surface through the light.
            ray = leave(*path.at, to_light, geometry.t_min);
            ray.t_max = 1 - 0x1p-10;
            add(kShadow, ray);
        }
        // Scatter the paths diffusely.
        for (std::size_t kind = kDiffuse; kind < kOcclusion; ++kind) {
            for (Path& path : paths) {
                path.ray = leave(*path.at, cosine_direction(path, 2 + 2 * kind), geometry.t_min);
                add(kind, path.ray);
            }
            follow(scene, paths);
        }
    }
    std::erase_if(sets, [](const RaySet& set) { return set.rays.empty(); });
    return sets;
}

}  // namespace limn::bench
