#include "bench/rays.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "bench/random.h"
#include "limn/core/frame.h"
#include "limn/core/warp.h"

namespace limn::bench {

namespace {

constexpr std::size_t kTile = 8;
constexpr int kMostPasses = 64;          // over the picture, to gather the rays of deep paths
constexpr double kOcclusionReach = 0.1;  // of the scene's diagonal
constexpr int kDepths = 3;

// Which dimension of the random numbers is what; each depth of a path has two.
constexpr std::uint64_t kPixel = 0, kOcclusion = 2, kScatter = 4;

struct Path {
    Surface at;
    std::uint64_t number;  // seeds its random numbers
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
          t_min_(to_float32(geometry.t_min)) {}

    std::vector<RaySet> make() {
        for (int pass = 0; pass < kMostPasses && !is_full(); ++pass) {
            std::vector<Ray> rays = primary(pass);
            std::vector<std::uint64_t> numbers(rays.size());
            std::iota(numbers.begin(), numbers.end(), static_cast<std::uint64_t>(pass) * rays.size());
            std::vector<Path> paths = follow(rays, numbers);
            add(primary_, rays);
            if (paths.empty()) break;
            gather(paths);
        }
        std::vector<RaySet> sets{std::move(primary_)};
        for (RaySet& set : diffuse_) sets.push_back(std::move(set));
        sets.push_back(std::move(occlusion_));
        sets.push_back(std::move(shadow_));
        std::erase_if(sets, [](const RaySet& set) { return set.rays.empty(); });
        return sets;
    }

private:
    bool is_full() const {
        return std::all_of(std::begin(diffuse_), std::end(diffuse_),
                           [&](const RaySet& set) { return set.rays.size() >= count_; }) &&
               shadow_.rays.size() >= count_;
    }

    void add(RaySet& set, const std::vector<Ray>& rays) const {
        const std::size_t room = count_ - std::min(count_, set.rays.size());
        const auto end = rays.begin() + static_cast<std::ptrdiff_t>(std::min(room, rays.size()));
        set.rays.insert(set.rays.end(), rays.begin(), end);
    }

    std::vector<Ray> primary(int pass) const {
        std::vector<Ray> rays;
        const std::size_t tiles = side_ / kTile;
        for (std::size_t tile = 0; tile < tiles * tiles; ++tile) {
            for (std::size_t k = 0; k < kTile * kTile; ++k) {
                const auto [x, y] = place_in_tile(k);
                const std::uint64_t number = static_cast<std::uint64_t>(pass) * side_ * side_ + rays.size();
                Ray ray =
                    camera_.ray(static_cast<double>(tile % tiles * kTile + x) + random(number, kPixel),
                                static_cast<double>(tile / tiles * kTile + y) + random(number, kPixel + 1), 0, 0, 0);
                ray.origin = to_float32(ray.origin);
                ray.direction = to_float32(normalize(ray.direction));
                rays.push_back(ray);
            }
        }
        return rays;
    }

    // Rays from the points that primary rays have met, and from where the paths go on to.
    void gather(std::vector<Path>& paths) {
        std::vector<Ray> rays;
        for (const Path& path : paths) {
            rays.push_back(leave(path.at, cosine_direction(path, kOcclusion)));
            rays.back().t_max = to_float32(kOcclusionReach * length(box_.diagonal()));
        }
        add(occlusion_, rays);
        rays.clear();
        for (const Path& path : paths) {
            if (dot(Vec3(path.at.normal), light_ - path.at.position) <= 0) continue;  // its own surface is in the way
            // t is the share of the way; a float32 just below 1 keeps what holds the light from being in its way.
            rays.push_back(leave(path.at, light_ - path.at.position));
            rays.back().t_max = 1 - 0x1p-10;
        }
        add(shadow_, rays);
        for (int depth = 0; depth < kDepths; ++depth) {
            rays.clear();
            for (const Path& path : paths)
                rays.push_back(
                    leave(path.at, cosine_direction(path, kScatter + 2 * static_cast<std::uint64_t>(depth))));
            add(diffuse_[depth], rays);
            std::vector<std::uint64_t> numbers;
            for (const Path& path : paths) numbers.push_back(path.number);
            paths = follow(rays, numbers);
        }
    }

    // The paths that go on: `numbers` are those of the rays.
    std::vector<Path> follow(const std::vector<Ray>& rays, const std::vector<std::uint64_t>& numbers) const {
        std::vector<std::optional<Surface>> ends(rays.size());
        tbb::parallel_for(std::size_t{0}, rays.size(), [&](std::size_t i) {
            if (const auto hit = scene_.closest_hit(rays[i])) ends[i] = scene_.surface_at(rays[i], *hit);
        });
        std::vector<Path> paths;
        for (std::size_t i = 0; i < rays.size(); ++i)
            if (ends[i]) paths.push_back({*ends[i], numbers[i]});
        return paths;
    }

    Vec3 cosine_direction(const Path& path, std::uint64_t dimension) const {
        const Vec3 local = sample_cosine_hemisphere(random(path.number, dimension), random(path.number, dimension + 1));
        return Frame(Vec3(path.at.normal)).to_world(local);
    }

    // spawn_ray leaves the surface in double; what rounding to float32 may move the origin by is added to that.
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
    RaySet primary_{.name = "primary", .any = false, .coherent = true, .rays = {}};
    RaySet diffuse_[kDepths] = {
        {.name = "diffuse1", .rays = {}}, {.name = "diffuse2", .rays = {}}, {.name = "diffuse3", .rays = {}}};
    RaySet occlusion_{.name = "occlusion", .any = true, .coherent = false, .rays = {}};
    RaySet shadow_{.name = "shadow", .any = true, .coherent = false, .rays = {}};
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
