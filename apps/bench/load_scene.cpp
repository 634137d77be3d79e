#include <filesystem>

#include "bench/scenes.h"
#include "limn/io/obj.h"

namespace limn::bench {

Geometry load_scene(const std::string& path) {
    const Model model = load_obj(path, {.textures = false});
    return {.name = std::filesystem::path(path).filename().string(),
            .mesh = model.meshes.front(),  // an OBJ gives one
            .places = {},
            .balls = {},
            .quads = {}};
}

}  // namespace limn::bench
