// Compiled scenes in files: see core/chunk_file.h. The versions are the format's and a digest of the sizes of what is
// written. The chunks are the values, the tables (flat/tables.h), names, those of materials, and then, each with its
// number, materials, meshes, images, the environment's image, and lattices. Contents whose checksums are right are
// taken for what a program wrote.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "flat/scene.h"

namespace limn::query {

std::array<std::uint32_t, 2> scene_file_versions();

// \throws ArgumentError if it has user-defined objects, FileError
void write_scene(const flat::Scene& scene, const std::string& path);
// \throws FileError
flat::Scene read_scene(const std::string& path);

}  // namespace limn::query
