/// \file
/// Triangle meshes.
#pragma once

#include <vector>

#include "limn/shape/hittable.h"

namespace limn {

/// The arrays of an indexed triangle mesh.
struct MeshData {
    std::vector<Float3> vertices;   ///< stored as given
    std::vector<Index3> triangles;  ///< rows of `vertices`, counter-clockwise seen from outside
    std::vector<Float3> normals;    ///< per vertex, of any length but zero; or empty: flat shading
    std::vector<Float2> uvs;        ///< texture coordinates per vertex; or empty: the weights of vertices b and c
    std::vector<std::uint32_t> material_slots;  ///< per triangle, which of the mesh's materials; or empty: the first
    std::vector<std::uint32_t> faces;  ///< per triangle, the index of the polygon it was cut from; or empty: its own
};

/// A triangle mesh. Its elements are in the order of `data.triangles`. u and v are the weights of the second and third
/// vertex. Triangles whose area is exactly zero are counted, and never hit; tiny and huge ones are ordinary. `hit`
/// tests every triangle: it is the definition; compile a scene to trace many rays.
class Mesh final : public Hittable {
public:
    /// \throws Error if there is no usable triangle; ArgumentError if an index or material slot is out of range, an
    /// array has the wrong length, a normal is zero, or a value is not finite
    ///@{
    Mesh(MeshData data, std::shared_ptr<const Material> material);
    Mesh(MeshData data, std::vector<std::shared_ptr<const Material>> materials);
    ///@}
    /// The same triangles, which are shared, of other materials. \throws ArgumentError if there are fewer of them
    Mesh(const Mesh& mesh, std::vector<std::shared_ptr<const Material>> materials);

    const MeshData& data() const { return *data_; }  ///< valid as long as the mesh
    const std::vector<std::shared_ptr<const Material>>& materials() const { return materials_; }  ///< by slot
    /// The index of the polygon that triangle `element` was cut from. \pre element < data().triangles.size()
    std::uint32_t face(std::uint64_t element) const;
    /// Triangles of exactly zero area, which no ray can hit.
    std::size_t degenerate_triangles() const { return degenerate_; }

    Box bounds() const override { return bounds_; }
    std::optional<Hit> hit(const Ray& ray) const override;
    void lower(RecordSink& sink) const override;

private:
    std::shared_ptr<const MeshData> data_;
    std::vector<std::shared_ptr<const Material>> materials_;
    Box bounds_;
    std::size_t degenerate_ = 0;
};

}  // namespace limn
