#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "io/gltf_materials.h"
#include "io/model_reader.h"

namespace limn {

// Reads the meshes of a glTF when nodes use them. Each primitive of a mesh becomes a mesh of the model. All of them
// share Model::materials.
class GltfMeshes {
public:
    GltfMeshes(const GltfValue& document, GltfBuffers& buffers, const std::vector<GltfMaterial>& materials,
               const ModelOptions& options, Model& model);

    // Returns the indices in Model::meshes of the primitives of a mesh, given by its number. Reads them the first time.
    // Primitives without usable triangles are left out.
    // \throws FileError naming the file and the place in the JSON
    const std::vector<std::size_t>& get(const GltfValue& number);

private:
    void add(const GltfValue& primitive, std::vector<std::size_t>& places);
    std::vector<Index3> triangles_of(const GltfValue& primitive, std::size_t vertices);
    MeshData mesh_of(const GltfValue& primitive, std::uint32_t slot);
    void add_attributes(const GltfValue& primitive, const std::vector<std::uint32_t>& used, std::uint32_t slot,
                        MeshData& data);
    const std::vector<float>& attribute(const GltfValue& number, const std::string& type, std::size_t vertices);
    void warn_once(const std::string& warning);

    GltfValue document_;
    GltfBuffers& buffers_;
    const std::vector<GltfMaterial>& materials_;
    std::vector<std::shared_ptr<const Material>> slots_;  // the default material, then `materials_`
    const ModelOptions& options_;
    Model& model_;
    FaceCutter cutter_;
    std::map<std::uint64_t, std::vector<std::size_t>> made_;  // the results of get()
    std::set<std::string> warnings_;                          // the warnings that have been given
    std::set<std::uint64_t> counted_;  // the accessors of positions that Model::vertices includes
};

}  // namespace limn
