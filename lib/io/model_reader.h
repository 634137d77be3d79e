// The readers of models, and what they share.
#pragma once

#include <span>
#include <string_view>

#include "io/polygon.h"
#include "limn/io/model.h"
#include "predicates/mesh_triangle.h"

namespace limn {

// Each reads a file in memory, which messages call `path`; what it names is beside that. \throws FileError, or a Fault
// of the file as a whole
Model read_gltf(std::string_view bytes, const std::string& path, const ModelOptions& options);
Model read_obj(std::string_view text, const std::string& path, const ModelOptions& options);
Model read_ply(std::string_view bytes, const std::string& path, const ModelOptions& options);
Model read_stl(std::string_view bytes, const std::string& path, const ModelOptions& options);

inline TriangleVertices triangle_of(std::span<const Float3> polygon, const Index3& t) {
    return {to_point(polygon[t.a]), to_point(polygon[t.b]), to_point(polygon[t.c])};
}

// Cuts faces into triangles that have an area; what it leaves out it counts in the model.
class FaceCutter {
public:
    explicit FaceCutter(Model& model) : model_(model) {}

    // Triangles as places in `polygon`; none if the face is dropped. \param unit,number where the face is, for a
    // warning
    const std::vector<Index3>& cut(std::span<const Float3> polygon, const char* unit, std::size_t number);

private:
    Model& model_;
    PolygonCutter cutter_;
    std::vector<Index3> triangles_;
};

// \param none what is missing where the file has no face at all
// \throws FileError if there is no triangle
void require_faces(const MeshData& mesh, const Model& model, const std::string& path, const std::string& none);

// Normals that are zero or not finite become those of the triangles around, texture coordinates that are not finite 0,
// with a warning.
void repair(MeshData& mesh, Model& model);

// For slot 0.
std::shared_ptr<const Material> default_material(const ModelOptions& options);

// Adds a mesh, smoothed if that is wanted, and an instance of it.
void add_mesh(Model& model, MeshData data, std::vector<std::shared_ptr<const Material>> materials,
              const ModelOptions& options);

}  // namespace limn
