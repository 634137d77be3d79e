// The only source that holds tinyobjloader, under a name of limn's own so that a program may link another copy.
#define tinyobj limn_tinyobj
#define TINYOBJLOADER_USE_DOUBLE
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

#include <sstream>
#include <utility>

#include "io/obj_parse.h"
#include "limn/core/error.h"

namespace limn {

namespace {

// The text holds float32 values, which survive the way through double.
Float3 to_float3(double x, double y, double z) {
    return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

struct Receiver {
    const CleanObj& clean;
    ObjFile& file;
    std::size_t material = ObjFace::kNoMaterial;
    std::size_t face_parts = 0;

    void add_face_part(const tinyobj::index_t* indices, int count) {
        const auto [number, line] = clean.face_parts.at(face_parts++);
        if (file.faces.empty() || file.faces.back().number != number)
            file.faces.push_back({number, line, file.corners.size(), 0, material});
        const std::size_t corner_count = static_cast<std::size_t>(count);
        file.faces.back().corner_count += corner_count;
        // Counted from 1, 0 for none.
        for (std::size_t i = 0; i < corner_count; ++i)
            file.corners.push_back(
                {indices[i].vertex_index - 1, indices[i].texcoord_index - 1, indices[i].normal_index - 1});
    }
};

tinyobj::callback_t callbacks() {
    tinyobj::callback_t result;
    result.vertex_cb = [](void* r, double x, double y, double z, double) {
        static_cast<Receiver*>(r)->file.positions.push_back(to_float3(x, y, z));
    };
    result.normal_cb = [](void* r, double x, double y, double z) {
        static_cast<Receiver*>(r)->file.normals.push_back(to_float3(x, y, z));
    };
    result.texcoord_cb = [](void* r, double u, double v, double) {
        static_cast<Receiver*>(r)->file.uvs.push_back({static_cast<float>(u), static_cast<float>(v)});
    };
    result.index_cb = [](void* r, tinyobj::index_t* indices, int count) {
        static_cast<Receiver*>(r)->add_face_part(indices, count);
    };
    result.usemtl_cb = [](void* r, const char* place, int) { static_cast<Receiver*>(r)->material = std::stoul(place); };
    return result;
}

void require_in_range(const ObjFile& file, const std::string& path) {
    for (const ObjFace& face : file.faces) {
        const auto check = [&](int index, std::size_t count, const char* name) {
            if (index >= static_cast<long long>(count))
                throw FileError(path, "line " + std::to_string(face.line) + ": a face refers to " + name + " " +
                                          std::to_string(index + 1LL) + ", but the file has " + std::to_string(count));
        };
        for (std::size_t i = 0; i < face.corner_count; ++i) {
            const ObjCorner& corner = file.corners[face.first_corner + i];
            check(corner.position, file.positions.size(), "vertex");
            check(corner.uv, file.uvs.size(), "texture coordinate");
            check(corner.normal, file.normals.size(), "normal");
        }
    }
}

}  // namespace

ObjFile parse_obj(std::string_view text, const std::string& path) {
    CleanObj clean = clean_obj(text, path);
    ObjFile file;
    Receiver receiver{clean, file};
    std::istringstream stream(std::move(clean.text));
    std::string errors;
    tinyobj::LoadObjWithCallback(stream, callbacks(), &receiver, nullptr, nullptr, &errors);
    if (!errors.empty() || receiver.face_parts != clean.face_parts.size())
        throw FileError(path, "cannot be read: " + errors);
    require_in_range(file, path);
    file.face_count = clean.face_count;
    file.materials = std::move(clean.materials);
    file.libraries = std::move(clean.libraries);
    file.warnings = std::move(clean.warnings);
    return file;
}

}  // namespace limn
