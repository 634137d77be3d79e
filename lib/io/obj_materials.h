#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/obj_parse.h"
#include "limn/io/obj.h"
#include "limn/material/material.h"

namespace limn {

/// A material for each name in ObjFile::materials, as the table in limn/io/obj.h says. What is missing is replaced by
/// `fallback`, with a warning; warnings and the names of files are added to `model`. \param textures whether images are
/// read \throws FileError naming the MTL and the line of a malformed number
std::vector<std::shared_ptr<const Material>> load_obj_materials(const ObjFile& file, const std::string& obj_path,
                                                                const std::shared_ptr<const Material>& fallback,
                                                                bool textures, Model& model);

}  // namespace limn
