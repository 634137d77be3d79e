#include "io/obj_mesh.h"

#include <algorithm>
#include <bit>
#include <span>
#include <unordered_map>

#include "io/polygon.h"
#include "predicates/mesh_triangle.h"

namespace limn {

namespace {

bool is_zero(const Float3& v) { return v.x == 0 && v.y == 0 && v.z == 0; }

class MeshBuilder {
public:
    explicit MeshBuilder(const ObjFile& file) : file_(file) {
        for (const ObjCorner& corner : file.corners) {
            has_normals_ = has_normals_ || corner.normal != ObjCorner::kNone;
            has_uvs_ = has_uvs_ || corner.uv != ObjCorner::kNone;
        }
        result_.dropped_faces = file.face_count - file.faces.size();
        if (!splits_vertices()) result_.data.vertices = file.positions;
    }

    ObjMesh build() {
        for (const ObjFace& face : file_.faces)
            if (!add(face)) ++result_.dropped_faces;
        return std::move(result_);
    }

private:
    struct Vertex {
        ObjCorner corner;
        Float3 normal;
        bool operator==(const Vertex&) const = default;
    };
    struct Hash {
        std::size_t operator()(const Vertex& v) const {
            const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x + 0.0f); };  // -0 equals 0
            std::size_t hash = 0;
            for (const std::uint32_t part :
                 {static_cast<std::uint32_t>(v.corner.position), static_cast<std::uint32_t>(v.corner.uv),
                  static_cast<std::uint32_t>(v.corner.normal), bits(v.normal.x), bits(v.normal.y), bits(v.normal.z)})
                hash = (hash ^ part) * 0x9e3779b97f4a7c15, hash ^= hash >> 32;  // 2^64 / golden ratio
            return hash;
        }
    };

    bool splits_vertices() const { return has_normals_ || has_uvs_; }

    // False if the face gives no triangle.
    bool add(const ObjFace& face) {
        if (face.corner_count < 3) return false;
        const std::span<const ObjCorner> corners(&file_.corners[face.first_corner], face.corner_count);
        polygon_.clear();
        for (const ObjCorner& corner : corners)
            polygon_.push_back(file_.positions[static_cast<std::size_t>(corner.position)]);
        if (!cutter_.cut(polygon_, triangles_)) {
            result_.warnings.push_back("line " + std::to_string(face.line) + ": a face of " +
                                       std::to_string(polygon_.size()) + " corners is too complicated to cut");
            return false;
        }
        const std::size_t before = triangles_.size();
        std::erase_if(triangles_, [this](const Index3& t) { return is_degenerate(corners_of(t)); });
        result_.degenerate_triangles += before - triangles_.size();
        if (triangles_.empty()) return false;
        vertices_.clear();
        for (const ObjCorner& corner : corners) vertices_.push_back(vertex(corner));
        for (const Index3& t : triangles_) {
            result_.data.triangles.push_back({vertices_[t.a], vertices_[t.b], vertices_[t.c]});
            result_.data.faces.push_back(static_cast<std::uint32_t>(face.number));
            const bool has_material = face.material != ObjFace::kNoMaterial;
            result_.data.material_slots.push_back(has_material ? static_cast<std::uint32_t>(face.material) + 1 : 0);
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
            if (is_zero(normal)) corner.normal = ObjCorner::kNone, normal = face_normal();
        }
        const std::uint32_t next = static_cast<std::uint32_t>(result_.data.vertices.size());
        const auto [found, is_new] = numbers_.try_emplace({corner, normal}, next);
        if (!is_new) return found->second;
        result_.data.vertices.push_back(file_.positions[static_cast<std::size_t>(corner.position)]);
        if (has_normals_) result_.data.normals.push_back(normal);
        if (has_uvs_)
            result_.data.uvs.push_back(corner.uv == ObjCorner::kNone ? Float2{}
                                                                     : file_.uvs[static_cast<std::size_t>(corner.uv)]);
        return next;
    }

    // Where the parts of a polygon cancel: that of its first triangle.
    Float3 face_normal() {
        if (!is_zero(face_normal_)) return face_normal_;
        Vec3 normal = newell_normal(polygon_);
        const TriangleVertices t = corners_of(triangles_[0]);
        if (normal == Vec3{}) normal = cross(t.b - t.a, t.c - t.a);
        normal = normalize(normal);
        return face_normal_ = {static_cast<float>(normal.x), static_cast<float>(normal.y),
                               static_cast<float>(normal.z)};
    }

    const ObjFile& file_;
    ObjMesh result_;
    bool has_normals_ = false, has_uvs_ = false;
    std::unordered_map<Vertex, std::uint32_t, Hash> numbers_;  // of the vertices, unless they are those of the file
    PolygonCutter cutter_;
    // Of the current face.
    std::vector<Float3> polygon_;
    std::vector<Index3> triangles_;
    std::vector<std::uint32_t> vertices_;
    Float3 face_normal_;
};

}  // namespace

ObjMesh build_mesh(const ObjFile& file) { return MeshBuilder(file).build(); }

}  // namespace limn
