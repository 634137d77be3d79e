/// \file
/// Triangle meshes.
#pragma once

#include <vector>

#include "limn/scene/shape/hittable.h"

namespace limn {

/// The arrays of an indexed triangle mesh.
struct MeshData {
    std::vector<Float3> vertices;   ///< positions; finite
    std::vector<Index3> triangles;  ///< indices of vertices, counter-clockwise seen from outside
    std::vector<Float3> normals;    ///< one for each vertex, of any length but zero; empty: flat shading
    std::vector<Float2> uvs;        ///< texture coordinates of each vertex; empty: the parameters u and v of triangles
    std::vector<std::uint32_t> material_slots;  ///< for each triangle, an index of a material; empty: all 0
    std::vector<std::uint32_t> faces;  ///< for each triangle, the polygon that it was cut from; empty: its own index
};

/// A triangle mesh. Hit::element is the index of the triangle in MeshData::triangles. Hit::u and Hit::v are the
/// barycentric weights of the triangle's second and third vertex. No ray hits a triangle whose area is exactly zero.
/// There is no other limit on the size of triangles. `hit` tests every triangle. To trace many rays, compile a scene.
class Mesh final : public BuiltInShape {
public:
    /// A material may be null in scenes that are queried and not rendered. An empty list of materials counts as one
    /// null material.
    ///
    /// \throws Error if no triangle has an area
    /// \throws ArgumentError if an index or a material slot is out of range, an array has the wrong length, a normal is
    /// zero, or a number is not finite
    ///@{
    Mesh(MeshData data, std::shared_ptr<const Material> material);
    Mesh(MeshData data, std::vector<std::shared_ptr<const Material>> materials);
    ///@}
    /// Makes a mesh of other materials that shares the arrays of `mesh`.
    ///
    /// \throws ArgumentError if there are fewer materials than `mesh` has
    Mesh(const Mesh& mesh, std::vector<std::shared_ptr<const Material>> materials);

    const MeshData& data() const { return *data_; }  ///< arrays; valid while the mesh exists
    const std::vector<std::shared_ptr<const Material>>& materials() const { return materials_; }  ///< materials by slot
    /// Returns the index of the polygon that a triangle was cut from. \pre element < data().triangles.size()
    std::uint32_t face(std::uint64_t element) const;
    /// Returns the number of triangles of exactly zero area.
    std::size_t degenerate_triangles() const { return degenerate_; }

    void lower(RecordSink& sink) const override;

private:
    Box box() const override { return bounds_; }
    std::optional<Hit> intersect(const Ray& ray) const override;

    std::shared_ptr<const MeshData> data_;
    std::vector<std::shared_ptr<const Material>> materials_;
    Box bounds_;
    std::size_t degenerate_ = 0;
};

}  // namespace limn
