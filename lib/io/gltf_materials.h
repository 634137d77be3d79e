#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "io/gltf_buffers.h"
#include "limn/io/model.h"
#include "limn/material/material.h"

namespace limn {

// How a picture lies: which texture coordinates, and where their (u, v) goes, v downward.
struct GltfPlace {
    std::uint64_t uv_set = 0;
    std::array<double, 3> u_of{1, 0, 0}, v_of{0, 1, 0};
    bool operator==(const GltfPlace&) const = default;
};

struct GltfMaterial {
    std::string name{};
    std::shared_ptr<const Material> material{};
    GltfPlace place{};  // of all its pictures
    bool has_pictures = false;
};

/// All materials of a glTF, as the table in docs/models.md says; what is not used becomes a warning of the model.
/// \throws FileError naming file and place
std::vector<GltfMaterial> load_gltf_materials(const GltfValue& document, GltfBuffers& buffers, const std::string& path,
                                              const ModelOptions& options, Model& model);

}  // namespace limn
