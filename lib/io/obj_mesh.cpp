#include <unordered_map>

#include "geometry/mesh_triangle.h"
#include "io/bytes_hash.h"
#include "io/model_reader.h"
#include "io/obj_reader.h"
#include "io/polygon.h"
#include "math/nearest_float3.h"

namespace limn {

namespace {

// Implements build_mesh().
class MeshBuilder {
public:
    MeshBuilder(const ObjFile& file, Model& model) : file_(file), cutter_(model) {
        for (const ObjCorner& corner : file.corners) {
            has_normals_ = has_normals_ || corner.normal != ObjCorner::kNone;
            has_uvs_ = has_uvs_ || corner.uv != ObjCorner::kNone;
        }
        if (!splits_vertices()) mesh_.vertices = file.positions;
    }

    MeshData build() {
        for (std::uint32_t i = 0; i < file_.faces.size(); ++i) add(file_.faces[i], i);
        return std::move(mesh_);
    }

private:
    // A vertex of the mesh. `normal` is the normal of its face if the corner names none.
    struct Vertex {
        ObjCorner corner;
        Float3 normal;
        bool operator==(const Vertex&) const = default;
    };

    // Returns true if a position of the file may become several vertices of the mesh.
    bool splits_vertices() const { return has_normals_ || has_uvs_; }

    // Adds the triangles of a face.
    void add(const ObjFace& face, std::uint32_t number) {
        // Cut the polygon into triangles.
        polygon_.clear();
        for (const ObjCorner& corner : file_.corners_of(face))
            polygon_.push_back(file_.positions[static_cast<std::size_t>(corner.position)]);
        const std::vector<Index3>& triangles = cutter_.cut(polygon_, "line", face.line);
        if (triangles.empty()) return;
        // Add the vertices and the triangles.
        face_normal_ = {};
        first_triangle_ = triangles[0];
        vertices_.clear();
        for (const ObjCorner& corner : file_.corners_of(face)) vertices_.push_back(vertex(corner));
        for (const Index3& t : triangles) {
            mesh_.triangles.push_back({vertices_[t.a], vertices_[t.b], vertices_[t.c]});
            mesh_.faces.push_back(number);
            mesh_.material_slots.push_back(face.slot);
        }
    }

    // Returns the index of the mesh vertex for a corner of the current face. Adds the vertex when it first occurs.
    std::uint32_t vertex(ObjCorner corner) {
        if (!splits_vertices()) return static_cast<std::uint32_t>(corner.position);
        // Take the normal of the face if the corner names none, or one of length zero.
        Float3 normal;
        if (has_normals_) {
            if (corner.normal != ObjCorner::kNone) normal = file_.normals[static_cast<std::size_t>(corner.normal)];
            if (normal == Float3{}) {
                corner.normal = ObjCorner::kNone;
                normal = face_normal();
            }
        }
        // Look the combination up.
        const std::uint32_t next = static_cast<std::uint32_t>(mesh_.vertices.size());
        const auto [found, is_new] = numbers_.try_emplace({corner, normal}, next);
        if (!is_new) return found->second;
        // Add a vertex.
        mesh_.vertices.push_back(file_.positions[static_cast<std::size_t>(corner.position)]);
        if (has_normals_) mesh_.normals.push_back(normal);
        if (has_uvs_)
            mesh_.uvs.push_back(corner.uv == ObjCorner::kNone ? Float2{}
                                                              : file_.uvs[static_cast<std::size_t>(corner.uv)]);
        return next;
    }

    // Returns the unit normal of the current face. If parts of the polygon cancel, so that it would be zero, returns
    // the normal of the first triangle.
    Float3 face_normal() {
        if (face_normal_ != Float3{}) return face_normal_;
        Vec3 normal = newell_normal(polygon_);
        const TriangleVertices t = triangle_of(polygon_, first_triangle_);
        if (normal == Vec3{}) normal = cross(t.b - t.a, t.c - t.a);
        return face_normal_ = nearest_float3(normalize(normal) + Vec3{});  // adding 0 turns -0 into +0, for BytesHash
    }

    const ObjFile& file_;
    MeshData mesh_;
    bool has_normals_ = false, has_uvs_ = false;
    std::unordered_map<Vertex, std::uint32_t, BytesHash> numbers_;  // indices of vertices, if splits_vertices()
    FaceCutter cutter_;
    // The current face.
    std::vector<Float3> polygon_;
    std::vector<std::uint32_t> vertices_;
    Float3 face_normal_;
    Index3 first_triangle_;
};

}  // namespace

MeshData build_mesh(const ObjFile& file, Model& model) { return MeshBuilder(file, model).build(); }

}  // namespace limn
