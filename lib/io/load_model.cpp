#include <filesystem>

#include "io/bytes.h"
#include "io/file_kind.h"
#include "io/model_reader.h"
#include "limn/math/error.h"
#include "math/system/read_file.h"

namespace limn {

namespace {

// Returns true if a file has the suffix of an STL. Only a damaged binary STL needs this test: its contents are not
// recognised.
bool is_named_stl(const std::string& path) {
    const std::string suffix = std::filesystem::path(path).extension().string();
    return suffix == ".stl" || suffix == ".STL";
}

// Reads a model with the reader of its format. Contents that are not recognised are read as an OBJ.
Model read_model(std::string_view bytes, const std::string& path, const ModelOptions& options) {
    const FileKind kind = kind_of_contents(bytes);
    if (kind.model == ModelFormat::gltf) return read_gltf(bytes, path, options);
    if (kind.model == ModelFormat::ply) return read_ply(bytes, path, options);
    if (kind.model == ModelFormat::stl || (kind.name.empty() && is_named_stl(path)))
        return read_stl(bytes, path, options);
    if (kind.name.empty() || kind.may_be_text) return read_obj(bytes, path, options);
    const char* hint = kind.name.starts_with("UTF-") ? "; saved as UTF-8 it can be read"
                                                     : "; models are read from OBJ, PLY, STL and glTF";
    throw FileError(path, "is no model: it appears to be " + std::string(kind.name) + hint);
}

}  // namespace

Model load_model(const std::string& path, const ModelOptions& options) {
    const std::string file = read_file(path);
    return load_model_from_memory(std::as_bytes(std::span(file)), path, options);
}

Model load_model_from_memory(std::span<const std::byte> bytes, const std::string& path, const ModelOptions& options) {
    try {
        return read_model(text_of(bytes), path, options);
    } catch (const Fault& fault) {
        throw FileError(path, fault.text);
    }
}

}  // namespace limn
