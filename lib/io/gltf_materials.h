#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "io/gltf_buffers.h"
#include "limn/io/model.h"
#include "limn/scene/material/material.h"

namespace limn {

// The mapping of a picture onto a surface: a set of texture coordinates and an affine transform of them. The
// transformed u is u_of[0] u + u_of[1] v + u_of[2], and likewise with v. v grows downward, as everywhere in glTF.
struct GltfPlace {
    std::uint64_t uv_set = 0;  // n of TEXCOORD_n
    std::array<double, 3> u_of{1, 0, 0}, v_of{0, 1, 0};
    bool operator==(const GltfPlace&) const = default;
};

struct GltfMaterial {
    std::string name{};
    std::shared_ptr<const Material> material{};
    GltfPlace place{};  // the mapping of all its pictures
    bool has_pictures = false;
};

// Converts all materials of a glTF, in the order of the file, as the table in docs/models.md says. What limn does not
// use becomes a warning of the model.
// \throws FileError naming the file and the place in the JSON
std::vector<GltfMaterial> load_gltf_materials(const GltfValue& document, GltfBuffers& buffers, const std::string& path,
                                              const ModelOptions& options, Model& model);

}  // namespace limn
