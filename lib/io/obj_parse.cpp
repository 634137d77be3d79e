// Parses OBJ files with tinyobjloader. This is the only source that contains tinyobjloader. Its namespace is renamed,
// so that a program may link another copy.
#define tinyobj limn_tinyobj
#define TINYOBJLOADER_USE_DOUBLE
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

#include <sstream>

#include "io/obj_reader.h"
#include "limn/math/error.h"
#include "math/nearest_float3.h"

namespace limn {

namespace {

// Returns the functions that store what tinyobjloader reads in an ObjFile. The text of clean_obj() holds exact float32
// values; they are not changed by the conversion to double and back.
tinyobj::callback_t callbacks() {
    tinyobj::callback_t result;
    result.vertex_cb = [](void* file, double x, double y, double z, double) {
        static_cast<ObjFile*>(file)->positions.push_back(nearest_float3({x, y, z}));
    };
    result.normal_cb = [](void* file, double x, double y, double z) {
        static_cast<ObjFile*>(file)->normals.push_back(nearest_float3({x, y, z}));
    };
    result.texcoord_cb = [](void* file, double u, double v, double) {
        static_cast<ObjFile*>(file)->uvs.push_back({static_cast<float>(u), static_cast<float>(v)});
    };
    // tinyobjloader counts from 1; an index of 0 is missing.
    result.index_cb = [](void* file, tinyobj::index_t* indices, int count) {
        for (const tinyobj::index_t& i : std::span(indices, static_cast<std::size_t>(count)))
            static_cast<ObjFile*>(file)->corners.push_back(
                {i.vertex_index - 1, i.texcoord_index - 1, i.normal_index - 1});
    };
    return result;
}

// Throws a FileError if a face refers to an element that the file does not have.
void require_in_range(const ObjFile& file, const std::string& path) {
    for (const ObjFace& face : file.faces) {
        const auto check = [&](int index, std::size_t count, const char* name) {
            if (index >= static_cast<long long>(count))
                throw FileError(path, "line " + std::to_string(face.line) + ": a face refers to " + name + " " +
                                          std::to_string(index + 1LL) + ", but the file has " + std::to_string(count));
        };
        for (const ObjCorner& corner : file.corners_of(face)) {
            check(corner.position, file.positions.size(), "vertex");
            check(corner.uv, file.uvs.size(), "texture coordinate");
            check(corner.normal, file.normals.size(), "normal");
        }
    }
}

}  // namespace

ObjFile parse_obj(std::string_view text, const std::string& path, Model& model) {
    ObjFile file;
    std::istringstream stream(clean_obj(text, path, file, model));
    std::string errors;
    tinyobj::LoadObjWithCallback(stream, callbacks(), &file, nullptr, nullptr, &errors);
    const std::size_t corners =
        file.faces.empty() ? 0 : file.faces.back().first_corner + file.faces.back().corner_count;
    if (!errors.empty() || file.corners.size() != corners) throw FileError(path, "cannot be read: " + errors);
    require_in_range(file, path);
    model.vertices = file.positions.size();
    model.faces = file.faces.size();
    return file;
}

}  // namespace limn
