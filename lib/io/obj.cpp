#include "limn/io/obj.h"

#include <iterator>

#include "core/read_file.h"
#include "io/file_kind.h"
#include "io/obj_materials.h"
#include "io/obj_mesh.h"
#include "io/obj_parse.h"
#include "limn/core/error.h"
#include "limn/material/lambertian.h"

namespace limn {

namespace {

[[noreturn]] void throw_no_usable_face(const std::string& path, std::size_t faces) {
    if (faces == 0) throw FileError(path, "has no usable face: there is no line with f");
    throw FileError(path,
                    "has no usable face: all " + std::to_string(faces) + " have fewer than three corners or no area");
}

// OBJ has no mark of its own, but others have.
void require_no_other_kind(const std::string& text, const std::string& path) {
    const FileKind kind = kind_of_contents(text);
    if (kind.name.empty() || kind.may_be_text) return;
    const char* hint =
        kind.name.starts_with("UTF-") ? "; saved as UTF-8 it can be read" : "; models are read from OBJ alone";
    throw FileError(path, "is no OBJ: it appears to be " + std::string(kind.name) + hint);
}

void append(std::vector<std::string>& all, std::vector<std::string>& more) {
    all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

Box Model::bounds() const {
    Box box;
    for (const auto& mesh : meshes) box.extend(mesh->bounds());
    return box;
}

Model load_obj(const std::string& path, const ObjOptions& options) {
    const std::string text = read_file(path);
    require_no_other_kind(text, path);
    ObjFile file = parse_obj(text, path);
    ObjMesh mesh = build_mesh(file);
    if (mesh.data.triangles.empty()) throw_no_usable_face(path, file.face_count);

    Model model;
    model.files = {path};
    model.vertices = file.positions.size();
    model.faces = file.face_count;
    model.dropped_faces = mesh.dropped_faces;
    model.degenerate_triangles = mesh.degenerate_triangles;
    append(model.warnings, file.warnings);
    append(model.warnings, mesh.warnings);
    const std::shared_ptr<const Material> fallback =
        options.default_material ? options.default_material : std::make_shared<Lambertian>(Color{0.5, 0.5, 0.5});
    std::vector<std::shared_ptr<const Material>> materials{fallback};
    for (auto& material : load_obj_materials(file, path, fallback, options.textures, model))
        materials.push_back(material);
    model.materials = std::move(file.materials);
    model.meshes.push_back(std::make_shared<Mesh>(std::move(mesh.data), std::move(materials)));
    return model;
}

}  // namespace limn
