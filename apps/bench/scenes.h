/// \file
/// The scenes and rays that limn and its peers trace. Every number is a float32, so that all of them trace the same.
#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "limn/limn.h"

namespace limn::bench {

struct Ball {
    Point3 center;
    double radius = 0;
};

struct Parallelogram {
    Point3 corner;
    Vec3 edge_u, edge_v;
};

// A scene without materials.
struct Geometry {
    std::string name;
    std::shared_ptr<const Mesh> mesh{};  // may be null
    std::vector<Transform> places{};     // world from object for each instance of the mesh; empty: the mesh itself
    std::vector<Ball> balls{};
    std::vector<Parallelogram> quads{};
    std::optional<Camera> camera{};  // by default frame_box() of all objects
    std::optional<Point3> light{};   // by default above the objects, in front of them to the left
    double t_min = 0;                // t_min of rays that leave a surface; if it is 0, Embree hits large spheres again
};

// Returns the names that make_scene accepts.
const std::vector<std::string>& scene_names();
// Returns the scene of a name. `scale` multiplies the number of primitives. \throws ArgumentError for another name
Geometry make_scene(const std::string& name, double scale);
// Returns the mesh of an OBJ file. \throws FileError
Geometry load_scene(const std::string& path);
// Returns the scene that limn compiles.
Scene describe(const Geometry& geometry);
// Returns the number of triangles, balls, quads and instances.
std::size_t stored_primitives(const Geometry& geometry);

struct RaySet {
    std::string name;       // the kind of the rays
    bool any = false;       // true for any-hit queries, false for closest-hit queries
    bool coherent = false;  // true if neighbouring rays are similar
    std::vector<Ray> rays;
};

// Returns the names of the kinds: "primary", "diffuse1" to "diffuse3", "occlusion" and "shadow".
const std::vector<std::string>& ray_kinds();
// Returns `count` rays of each kind, the same ones at each call. There are fewer if too many paths leave the scene. A
// kind without rays has no set. Diffuse, occlusion and shadow rays start at hits that limn finds.
std::vector<RaySet> make_rays(const Geometry& geometry, const CompiledScene& scene, std::size_t count);

inline Float3 to_float3(const auto& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// Returns the nearest float32 as a double.
inline double to_float32(double x) { return static_cast<double>(static_cast<float>(x)); }
inline Vec3 to_float32(const Vec3& v) { return {to_float32(v.x), to_float32(v.y), to_float32(v.z)}; }
inline Point3 to_float32(const Point3& p) { return {to_float32(p.x), to_float32(p.y), to_float32(p.z)}; }

// Returns a function of a dimension from 0 to 63 that returns pseudorandom numbers in [0, 1). The mixer is SplitMix64
// (Steele, Lea, Flood, Fast Splittable Pseudorandom Number Generators, 2014).
inline auto random_numbers(std::uint64_t seed, std::integral auto place) {
    return [seed, first = static_cast<std::uint64_t>(place) * 64 + 1](std::uint64_t dimension) {
        std::uint64_t x = seed + 0x9e3779b97f4a7c15 * (first + dimension);
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
        x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
        return static_cast<double>((x ^ (x >> 31)) >> 11) * 0x1p-53;
    };
}

}  // namespace limn::bench
