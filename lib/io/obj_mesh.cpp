#include <algorithm>
#include <unordered_map>

#include "io/bytes_hash.h"
#include "io/obj_reader.h"
#include "io/polygon.h"
#include "predicates/mesh_triangle.h"

namespace limn {

namespace {

class MeshBuilder {
public:
    MeshBuilder(const ObjFile& file, Model& model) : file_(file), model_(model) {
        for (const ObjCorner& corner : file.corners) {
            has_normals_ = has_normals_ || corner.normal != ObjCorner::kNone;
            has_uvs_ = has_uvs_ || corner.uv != ObjCorner::kNone;
        }
        if (!splits_vertices()) mesh_.vertices = file.positions;
    }

    MeshData build() {
        for (std::uint32_t i = 0; i < file_.faces.size(); ++i)
            if (!add(file_.faces[i], i)) ++model_.dropped_faces;
        return std::move(mesh_);
    }

private:
    struct Vertex {
        ObjCorner corner;
        Float3 normal;
        bool operator==(const Vertex&) const = default;
    };

    bool splits_vertices() const { return has_normals_ || has_uvs_; }

    // False if the face gives no triangle.
    bool add(const ObjFace& face, std::uint32_t number) {
        if (face.corner_count < 3) return false;
        polygon_.clear();
        for (const ObjCorner& corner : file_.corners_of(face))
            polygon_.push_back(file_.positions[static_cast<std::size_t>(corner.position)]);
        if (!cutter_.cut(polygon_, triangles_)) {
            model_.warnings.push_back("line " + std::to_string(face.line) + ": a face of " +
                                      std::to_string(polygon_.size()) + " corners is too complicated to cut");
            return false;
        }
        model_.degenerate_triangles +=
            std::erase_if(triangles_, [this](const Index3& t) { return is_degenerate(corners_of(t)); });
        if (triangles_.empty()) return false;
        vertices_.clear();
        for (const ObjCorner& corner : file_.corners_of(face)) vertices_.push_back(vertex(corner));
        for (const Index3& t : triangles_) {
            mesh_.triangles.push_back({vertices_[t.a], vertices_[t.b], vertices_[t.c]});
            mesh_.faces.push_back(number);
            mesh_.material_slots.push_back(face.slot);
        }
        face_normal_ = {};
        return true;
    }

    TriangleVertices corners_of(const Index3& t) const {
        return {to_point(polygon_[t.a]), to_point(polygon_[t.b]), to_point(polygon_[t.c])};
    }

    // The number of the mesh vertex that stands for a corner of the current face.
    std::uint32_t vertex(ObjCorner corner) {
        if (!splits_vertices()) return static_cast<std::uint32_t>(corner.position);
        Float3 normal;
        if (has_normals_) {
            if (corner.normal != ObjCorner::kNone) normal = file_.normals[static_cast<std::size_t>(corner.normal)];
            if (normal == Float3{}) corner.normal = ObjCorner::kNone, normal = face_normal();
        }
        const std::uint32_t next = static_cast<std::uint32_t>(mesh_.vertices.size());
        const auto [found, is_new] = numbers_.try_emplace({corner, normal}, next);
        if (!is_new) return found->second;
        mesh_.vertices.push_back(file_.positions[static_cast<std::size_t>(corner.position)]);
        if (has_normals_) mesh_.normals.push_back(normal);
        if (has_uvs_)
            mesh_.uvs.push_back(corner.uv == ObjCorner::kNone ? Float2{}
                                                              : file_.uvs[static_cast<std::size_t>(corner.uv)]);
        return next;
    }

    // Where the parts of a polygon cancel: that of its first triangle.
    Float3 face_normal() {
        if (face_normal_ != Float3{}) return face_normal_;
        Vec3 normal = newell_normal(polygon_);
        const TriangleVertices t = corners_of(triangles_[0]);
        if (normal == Vec3{}) normal = cross(t.b - t.a, t.c - t.a);
        normal = normalize(normal) + Vec3{};  // no -0
        return face_normal_ = {static_cast<float>(normal.x), static_cast<float>(normal.y),
                               static_cast<float>(normal.z)};
    }

    const ObjFile& file_;
    Model& model_;
    MeshData mesh_;
    bool has_normals_ = false, has_uvs_ = false;
    std::unordered_map<Vertex, std::uint32_t, BytesHash>
        numbers_;  // of the vertices, unless they are those of the file
    PolygonCutter cutter_;
    // Of the current face.
    std::vector<Float3> polygon_;
    std::vector<Index3> triangles_;
    std::vector<std::uint32_t> vertices_;
    Float3 face_normal_;
};

}  // namespace

MeshData build_mesh(const ObjFile& file, Model& model) { return MeshBuilder(file, model).build(); }

}  // namespace limn
