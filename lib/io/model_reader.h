// Declares the readers of all model formats and the functions that they share.
#pragma once

#include <span>
#include <string_view>

#include "geometry/mesh_triangle.h"
#include "io/polygon.h"
#include "limn/io/model.h"

namespace limn {

// Read a model from the bytes of a file. Messages call the file `path`, and the paths of other files in it are relative
// to `path`. \throws FileError; \throws Fault if the file as a whole is not readable
Model read_gltf(std::string_view bytes, const std::string& path, const ModelOptions& options);
Model read_obj(std::string_view text, const std::string& path, const ModelOptions& options);
Model read_ply(std::string_view bytes, const std::string& path, const ModelOptions& options);
Model read_stl(std::string_view bytes, const std::string& path, const ModelOptions& options);

// Returns the vertices of a triangle with indices into `polygon`.
inline TriangleVertices triangle_of(std::span<const Float3> polygon, const Index3& t) {
    return {to_point(polygon[t.a]), to_point(polygon[t.b]), to_point(polygon[t.c])};
}

// Cuts faces into triangles that have an area. Counts the triangles and faces that it leaves out in the model.
class FaceCutter {
public:
    explicit FaceCutter(Model& model) : model_(model) {}

    // Returns the triangles as indices into `polygon`; none if the face is dropped. The vector is valid until the next
    // call. A face that is too complicated is dropped with a warning.
    // \param unit,number the place of the face, for the warning: "line" and 12, for example
    const std::vector<Index3>& cut(std::span<const Float3> polygon, const char* unit, std::size_t number);

private:
    Model& model_;
    PolygonCutter cutter_;
    std::vector<Index3> triangles_;
};

// Checks that there are triangles.
// \param none what the message says if the file has no face at all
// \throws FileError naming `path` if there is no triangle
void require_faces(const MeshData& mesh, const Model& model, const std::string& path, const std::string& none);

// Replaces normals that are zero or not finite by the mean normal of the adjacent triangles, and texture coordinates
// that are not finite by (0, 0). Gives a warning for each kind.
void repair(MeshData& mesh, Model& model);

// Returns the material of slot 0, for faces that name no material.
std::shared_ptr<const Material> default_material(const ModelOptions& options);

// Adds a mesh and an instance of it to the model. If the mesh has no normals and `options.crease` is set, it gets
// smooth ones.
void add_mesh(Model& model, MeshData data, std::vector<std::shared_ptr<const Material>> materials,
              const ModelOptions& options);

}  // namespace limn
