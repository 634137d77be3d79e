#include "io/file_kind.h"
#include "io/model_reader.h"
#include "io/obj_reader.h"
#include "limn/math/error.h"
#include "math/system/read_file.h"

namespace limn {

namespace {

// Throws a FileError if the contents are recognised as another kind of file, unless a text may begin like that. An OBJ
// itself has no mark to recognise.
void require_no_other_kind(const std::string& text, const std::string& path) {
    const FileKind kind = kind_of_contents(text);
    if (kind.name.empty() || kind.may_be_text) return;
    const char* hint = kind.name.starts_with("UTF-") ? "; saved as UTF-8 it can be read"
                       : kind.model                  ? "; load_model reads it"
                                                     : "";
    throw FileError(path, "is no OBJ: it appears to be " + std::string(kind.name) + hint);
}

}  // namespace

Model load_obj(const std::string& path, const ObjOptions& options) {
    const std::string text = read_file(path);
    require_no_other_kind(text, path);
    return read_obj(text, path, options);
}

Model read_obj(std::string_view text, const std::string& path, const ModelOptions& options) {
    Model model;
    model.files = {path};
    const ObjFile file = parse_obj(text, path, model);
    MeshData mesh = build_mesh(file, model);
    require_faces(mesh, model, path, "there is no line with f");
    add_mesh(model, std::move(mesh), load_obj_materials(file, path, options, model), options);
    return model;
}

}  // namespace limn
