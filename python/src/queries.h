// Functions and types that the bindings of ray queries and point queries share.
#pragma once

#include <nanobind/nanobind.h>

#include "arguments.h"
#include "limn/query/compiled_scene.h"

namespace limn::python {

// The id of an object or primitive if there is none, as in Open3D.
inline constexpr std::uint32_t kInvalidId = 0xffffffff;

// Add the methods that query rays and points.
void bind_ray_queries(nb::class_<CompiledScene>& type);
void bind_point_queries(nb::class_<CompiledScene>& type);

// Returns the unit outward normal at a hit, also if the ray comes from the inside.
inline Vec3 outward_normal(const CompiledScene& scene, const Ray& ray, const RayHit& hit) {
    const Surface surface = scene.surface_at(ray, hit);
    const Vec3 normal(surface.normal);
    return surface.front_face ? normal : -normal;
}

// Writes the three coordinates to `values`.
template <class T>
void store(T* values, const Vec3& v) {
    values[0] = static_cast<T>(v.x);
    values[1] = static_cast<T>(v.y);
    values[2] = static_cast<T>(v.z);
}

// The result arrays that describe hits, with a row for each ray, point or hit.
template <class T>
struct MetArrays {
    NewArray<std::uint32_t> geometry_ids, primitive_ids;
    NewArray<T> primitive_uvs, primitive_normals;

    explicit MetArrays(const std::vector<std::size_t>& shape, bool with_normals = true)
        : geometry_ids(new_array<std::uint32_t>(shape)),
          primitive_ids(new_array<std::uint32_t>(shape)),
          primitive_uvs(new_array<T>(shape, 2)) {
        if (with_normals) primitive_normals = new_array<T>(shape, 3);
    }

    // Writes a hit, except for its normal.
    void set(std::size_t row, const RayHit& hit) const {
        geometry_ids.values[row] = hit.object;
        primitive_ids.values[row] = static_cast<std::uint32_t>(hit.element);
        primitive_uvs.values[2 * row] = static_cast<T>(hit.u);
        primitive_uvs.values[2 * row + 1] = static_cast<T>(hit.v);
    }
    // Writes a miss. \pre the arrays have normals
    void set_nothing(std::size_t row) const {
        geometry_ids.values[row] = primitive_ids.values[row] = kInvalidId;
        primitive_uvs.values[2 * row] = primitive_uvs.values[2 * row + 1] = 0;
        store(primitive_normals.values + 3 * row, Vec3{});
    }
    // Adds the arrays to a dict.
    void put_into(nb::dict& answer) const {
        answer["geometry_ids"] = geometry_ids.array;
        answer["primitive_ids"] = primitive_ids.array;
        answer["primitive_uvs"] = primitive_uvs.array;
        if (primitive_normals.values) answer["primitive_normals"] = primitive_normals.array;
    }
};

// Returns ask(double()) or ask(float()), by the argument `dtype`.
template <class Ask>
nb::object with_type(NameArgument type, const Ask& ask) {
    return choice(type, "dtype", {"float64", "float32"}) == 0 ? ask(double()) : ask(float());
}

}  // namespace limn::python
