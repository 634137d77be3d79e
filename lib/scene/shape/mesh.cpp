#include "limn/scene/shape/mesh.h"

#include <algorithm>
#include <string>

#include "geometry/hit_error.h"
#include "geometry/intersect.h"
#include "geometry/mesh_triangle.h"
#include "math/float_environment.h"
#include "scene/shape/arguments.h"

namespace limn {

namespace {

// Throws ArgumentError if the data isn't valid for a mesh with this number of materials.
void check(const MeshData& data, std::size_t materials) {
    // Check the lengths of arrays.
    require_length(data.normals.size(), data.vertices.size(), "Mesh", "normals");
    require_length(data.uvs.size(), data.vertices.size(), "Mesh", "uvs");
    require_length(data.material_slots.size(), data.triangles.size(), "Mesh", "material_slots");
    require_length(data.faces.size(), data.triangles.size(), "Mesh", "faces");
    // Check the values at vertices.
    for (std::size_t i = 0; i < data.vertices.size(); ++i)
        require_finite(to_vec(data.vertices[i]), "Mesh", ("vertex " + std::to_string(i)).c_str());
    for (std::size_t i = 0; i < data.normals.size(); ++i) {
        const Vec3 n = to_vec(data.normals[i]);
        if (!is_finite(n) || n == Vec3{})
            throw ArgumentError("Mesh: normal " + std::to_string(i) + " must be finite and not zero");
    }
    for (std::size_t i = 0; i < data.uvs.size(); ++i)
        if (!std::isfinite(data.uvs[i].u) || !std::isfinite(data.uvs[i].v))
            throw ArgumentError("Mesh: texture coordinate " + std::to_string(i) + " must be finite");
    // Check the indices of vertices and materials.
    for (std::size_t i = 0; i < data.triangles.size(); ++i) {
        const Index3 t = data.triangles[i];
        const std::uint32_t last = std::max({t.a, t.b, t.c});
        if (last >= data.vertices.size())
            throw ArgumentError("Mesh: triangle " + std::to_string(i) + " refers to vertex " + std::to_string(last) +
                                " of " + std::to_string(data.vertices.size()));
    }
    for (std::size_t i = 0; i < data.material_slots.size(); ++i)
        if (data.material_slots[i] >= materials)
            throw ArgumentError("Mesh: triangle " + std::to_string(i) + " refers to material " +
                                std::to_string(data.material_slots[i]) + " of " + std::to_string(materials));
}

MeshView view_of(const MeshData& data) {
    return {data.vertices, data.triangles, data.normals, data.uvs, data.material_slots};
}

}  // namespace

Mesh::Mesh(MeshData data, std::shared_ptr<const Material> material)
    : Mesh(std::move(data), std::vector<std::shared_ptr<const Material>>{std::move(material)}) {}

Mesh::Mesh(MeshData data, std::vector<std::shared_ptr<const Material>> materials)
    : data_(std::make_shared<const MeshData>(std::move(data))), materials_(std::move(materials)) {
    const FloatEnvironment environment;
    if (materials_.empty()) materials_.emplace_back();
    check(*data_, materials_.size());
    const MeshView mesh = view_of(*data_);
    for (std::size_t i = 0; i < data_->triangles.size(); ++i) {
        const TriangleVertices v = triangle_vertices(mesh, i);
        if (is_degenerate(v)) {
            ++degenerate_;
            continue;
        }
        bounds_.extend(triangle_bounds(v));
    }
    if (degenerate_ == data_->triangles.size()) throw Error("Mesh: there is no triangle with an area");
}

Mesh::Mesh(const Mesh& mesh, std::vector<std::shared_ptr<const Material>> materials) : Mesh(mesh) {
    if (materials.size() < materials_.size())
        throw ArgumentError("Mesh: " + std::to_string(materials.size()) + " materials in place of " +
                            std::to_string(materials_.size()));
    materials_ = std::move(materials);
}

std::uint32_t Mesh::face(std::uint64_t element) const {
    return data_->faces.empty() ? static_cast<std::uint32_t>(element) : data_->faces.at(element);
}

std::optional<Hit> Mesh::intersect(const Ray& ray) const {
    const MeshView mesh = view_of(*data_);
    PlanarHit nearest;
    const std::size_t element = intersect_mesh(mesh, frame_of(ray), {ray.t_min, ray.t_max}, nearest);
    if (element == data_->triangles.size()) return std::nullopt;
    const TriangleVertices v = triangle_vertices(mesh, element);
    const Normal3 normal = triangle_normal(v.a, v.b, v.c);
    const std::uint32_t slot = data_->material_slots.empty() ? 0 : data_->material_slots[element];
    return Hit{.t = nearest.t,
               .normal = normal,
               .u = nearest.u,
               .v = nearest.v,
               .material = materials_[slot].get(),
               .element = element,
               .shading_normal = shading_normal(mesh, element, nearest, normal),
               .uv = texture_coordinates(mesh, element, nearest),
               .position_error = planar_error(v.a, v.b - v.a, v.c - v.a)};
}

void Mesh::lower(RecordSink& sink) const {
    std::vector<MaterialId> ids;
    for (const auto& material : materials_) ids.push_back(lower_material(sink, material));
    sink.mesh({view_of(*data_), std::move(ids)}, data_);
}

}  // namespace limn
