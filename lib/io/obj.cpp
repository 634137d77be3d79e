#include "core/read_file.h"
#include "io/file_kind.h"
#include "io/obj_reader.h"
#include "limn/core/error.h"

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

}  // namespace

Box Model::bounds() const {
    Box box;
    for (const auto& mesh : meshes) box.extend(mesh->bounds());
    return box;
}

Model load_obj(const std::string& path, const ObjOptions& options) {
    const std::string text = read_file(path);
    require_no_other_kind(text, path);
    Model model;
    model.files = {path};
    const ObjFile file = parse_obj(text, path, model);
    MeshData mesh = build_mesh(file, model);
    if (mesh.triangles.empty()) throw_no_usable_face(path, model.faces);
    model.meshes.push_back(std::make_shared<Mesh>(std::move(mesh), load_obj_materials(file, path, options, model)));
    return model;
}

}  // namespace limn
