/// \file
/// The scenes that limn and its peers are given: arrays in which every number is a float32, so that all trace the same.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "limn/scene/camera.h"
#include "limn/scene/scene.h"
#include "limn/shape/mesh.h"

namespace limn::bench {

struct Ball {
    Point3 center;
    double radius = 0;
};

struct Parallelogram {
    Point3 corner;
    Vec3 edge_u, edge_v;
};

struct Geometry {
    std::string name;
    std::shared_ptr<const Mesh> mesh{};  // or null
    std::vector<Transform> places{};     // world from object: instances of the mesh; empty: the mesh itself
    std::vector<Ball> balls{};
    std::vector<Parallelogram> quads{};
    std::optional<Camera> camera{};  // by default the one that frames all
    std::optional<Point3> light{};   // by default above, to the left in front
    // The least t of rays that leave a surface. limn needs 0. Embree needs more for large spheres, where a ray hits the
    // surface that it leaves.
    double t_min = 0;
};

// The names that make_scene knows.
const std::vector<std::string>& scene_names();

// `scale` multiplies the number of primitives.
Geometry make_scene(const std::string& name, double scale);

// \throws FileError
Geometry load_scene(const std::string& path);

// The description that limn compiles.
Scene describe(const Geometry& geometry);

std::size_t stored_primitives(const Geometry& geometry);

// The nearest float32, as a double.
inline double to_float32(double x) { return static_cast<double>(static_cast<float>(x)); }
inline Vec3 to_float32(const Vec3& v) { return {to_float32(v.x), to_float32(v.y), to_float32(v.z)}; }
inline Point3 to_float32(const Point3& p) { return {to_float32(p.x), to_float32(p.y), to_float32(p.z)}; }

}  // namespace limn::bench
