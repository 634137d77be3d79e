#include "io/model_reader.h"

#include <cmath>

#include "limn/math/error.h"
#include "limn/scene/material/lambertian.h"
#include "limn/scene/shape/smooth_normals.h"
#include "math/nearest_float3.h"

namespace limn {

namespace {

// Returns a unit normal for each vertex: the mean of the normals of its triangles, weighted by area. Where they cancel
// or there is no triangle, it is (0, 0, 1).
std::vector<Vec3> normals_around(const MeshData& mesh) {
    std::vector<Vec3> sums(mesh.vertices.size());
    for (const Index3& t : mesh.triangles) {
        const auto [a, b, c] = triangle_of(mesh.vertices, t);
        const Vec3 normal = cross(b - a, c - a);
        for (const std::uint32_t i : {t.a, t.b, t.c}) sums[i] = sums[i] + normal;
    }
    for (Vec3& sum : sums) {
        sum = normalize(sum);
        if (!is_finite(sum)) sum = {0, 0, 1};
    }
    return sums;
}

}  // namespace

const std::vector<Index3>& FaceCutter::cut(std::span<const Float3> polygon, const char* unit, std::size_t number) {
    triangles_.clear();
    if (polygon.size() >= 3 && !cutter_.cut(polygon, triangles_)) {
        triangles_.clear();
        model_.warnings.push_back(std::string(unit) + " " + std::to_string(number) + ": a face of " +
                                  std::to_string(polygon.size()) + " corners is too complicated to cut");
    }
    model_.degenerate_triangles +=
        std::erase_if(triangles_, [&](const Index3& t) { return is_degenerate(triangle_of(polygon, t)); });
    if (triangles_.empty()) ++model_.dropped_faces;
    return triangles_;
}

void require_faces(const MeshData& mesh, const Model& model, const std::string& path, const std::string& none) {
    if (!mesh.triangles.empty()) return;
    throw FileError(path,
                    "has no usable face: " + (model.faces == 0 ? none
                                                               : "all " + std::to_string(model.faces) +
                                                                     " have fewer than three corners or no area"));
}

void repair(MeshData& mesh, Model& model) {
    const auto warn = [&](std::size_t count, const char* what, const char* instead) {
        if (count > 0) model.warnings.push_back(std::to_string(count) + what + " of a vertex " + instead);
    };
    // Replace normals. Compute those of the triangles only if any is needed.
    std::vector<Vec3> around;
    std::size_t normals = 0, uvs = 0;
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        const Vec3 normal = to_vec(mesh.normals[i]);
        if (is_finite(normal) && normal != Vec3{}) continue;
        if (around.empty()) around = normals_around(mesh);
        mesh.normals[i] = nearest_float3(around[i]);
        ++normals;
    }
    // Replace texture coordinates.
    for (Float2& uv : mesh.uvs) {
        if (std::isfinite(uv.u) && std::isfinite(uv.v)) continue;
        uv = {};
        ++uvs;
    }
    warn(normals, " times the normal", "is zero or not finite; the normal of the triangles around is used");
    warn(uvs, " times the texture coordinate", "is not finite; 0 is used");
}

std::shared_ptr<const Material> default_material(const ModelOptions& options) {
    if (options.default_material) return options.default_material;
    return std::make_shared<Lambertian>(Color{0.5, 0.5, 0.5});
}

void add_mesh(Model& model, MeshData data, std::vector<std::shared_ptr<const Material>> materials,
              const ModelOptions& options) {
    if (options.crease && data.normals.empty()) data = smooth_normals(data, *options.crease);
    model.instances.push_back({model.meshes.size()});
    model.meshes.push_back(std::make_shared<Mesh>(std::move(data), std::move(materials)));
}

}  // namespace limn
