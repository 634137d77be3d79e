#include "io/gltf_meshes.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "io/text_lines.h"

namespace limn {

namespace {

// The topologies of triangles. Lower numbers are points and lines.
enum Mode : std::uint64_t { kTriangles = 4, kStrip, kFan };

// Returns the triangles that `count` consecutive corners form (glTF 2.0, 3.7.2.1).
std::vector<Index3> corners_of(std::uint64_t mode, std::uint32_t count) {
    std::vector<Index3> corners;
    if (mode == kTriangles)
        for (std::uint32_t i = 0; count - i >= 3; i += 3) corners.push_back({i, i + 1, i + 2});
    else
        for (std::uint32_t i = 0; i + 2 < count; ++i)
            corners.push_back(mode == kFan ? Index3{i + 1, i + 2, 0} : Index3{i, i + 1 + i % 2, i + 2 - i % 2});
    return corners;
}

Float3 three(const std::vector<float>& values, std::size_t i) {
    return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

bool all_finite(const Float3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

}  // namespace

GltfMeshes::GltfMeshes(const GltfValue& document, GltfBuffers& buffers, const std::vector<GltfMaterial>& materials,
                       const ModelOptions& options, Model& model)
    : document_(document), buffers_(buffers), materials_(materials), options_(options), model_(model), cutter_(model) {
    slots_.push_back(default_material(options));
    for (const GltfMaterial& material : materials) {
        slots_.push_back(material.material);
        model.materials.push_back(material.name);
    }
}

const std::vector<std::size_t>& GltfMeshes::get(const GltfValue& number) {
    const GltfValue mesh = number.in(document_["meshes"]);
    const auto [place, is_new] = made_.try_emplace(number.natural());
    if (is_new)
        for (std::size_t i = 0; i < mesh["primitives"].size(); ++i) add(mesh["primitives"][i], place->second);
    return place->second;
}

// Reads a primitive and appends its index in Model::meshes to `places`. Does nothing if it has no usable triangle.
void GltfMeshes::add(const GltfValue& primitive, std::vector<std::size_t>& places) {
    const std::uint64_t mode = primitive["mode"].natural_or(kTriangles);
    if (mode > kFan) primitive["mode"].fail("is none of 0 to 6");
    if (primitive["extensions"]["KHR_draco_mesh_compression"].exists())
        primitive.fail("is packed by KHR_draco_mesh_compression, which is not read");
    if (mode < kTriangles) return warn_once("points and lines are not used");
    if (!primitive["attributes"]["POSITION"].exists()) return warn_once("triangles without POSITION are not used");
    if (primitive["attributes"]["COLOR_0"].exists()) warn_once("colours of vertices (COLOR_0) are not used");
    if (primitive["targets"].exists()) warn_once("morph targets are not used");
    const GltfValue material = primitive["material"];
    if (material.exists()) material.in(document_["materials"]);
    MeshData data = mesh_of(primitive, material.exists() ? static_cast<std::uint32_t>(material.natural() + 1) : 0);
    if (data.triangles.empty()) return;
    repair(data, model_);
    places.push_back(model_.meshes.size());
    add_mesh(model_, std::move(data), slots_, options_);
    model_.instances.pop_back();  // GltfReader adds the instances
}

// Returns the triangles of a primitive as indices of its vertices.
std::vector<Index3> GltfMeshes::triangles_of(const GltfValue& primitive, std::size_t vertices) {
    const std::uint64_t mode = primitive["mode"].natural_or(kTriangles);
    const GltfValue number = primitive["indices"];
    if (!number.exists()) return corners_of(mode, static_cast<std::uint32_t>(vertices));
    const std::vector<std::uint32_t> indices = buffers_.indices(number);
    for (std::size_t i = 0; i < indices.size(); ++i)
        if (indices[i] >= vertices)
            number.fail("index " + std::to_string(i) + " refers to vertex " + std::to_string(indices[i]) +
                        ", but there are " + std::to_string(vertices));
    std::vector<Index3> triangles = corners_of(mode, static_cast<std::uint32_t>(indices.size()));
    for (Index3& t : triangles) t = {indices[t.a], indices[t.b], indices[t.c]};
    return triangles;
}

// Returns the mesh of a primitive. Several primitives may share their vertices; the mesh gets only those that its own
// triangles use.
MeshData GltfMeshes::mesh_of(const GltfValue& primitive, std::uint32_t slot) {
    // Read the positions, and count them unless an earlier primitive has used them.
    const GltfValue number = primitive["attributes"]["POSITION"];
    const std::vector<float>& positions = buffers_.floats(number, "VEC3");
    const std::size_t vertices = positions.size() / 3;
    if (counted_.insert(number.natural()).second) model_.vertices += vertices;
    // own(vertex) returns the number of a vertex in the mesh, and adds it when it is first used.
    constexpr std::uint32_t kNone = 0xffffffff;
    std::vector<std::uint32_t> numbers(vertices, kNone), used;
    const auto own = [&](std::uint32_t vertex) {
        if (numbers[vertex] == kNone) {
            numbers[vertex] = static_cast<std::uint32_t>(used.size());
            used.push_back(vertex);
        }
        return numbers[vertex];
    };
    // Add all triangles that have an area.
    MeshData data;
    for (const Index3& t : triangles_of(primitive, vertices)) {
        const Float3 corners[3] = {three(positions, t.a), three(positions, t.b), three(positions, t.c)};
        if (!std::all_of(std::begin(corners), std::end(corners), all_finite))
            number.fail("a vertex of face " + std::to_string(model_.faces) + " is not finite");
        const auto face = static_cast<std::uint32_t>(model_.faces++);
        if (cutter_.cut(corners, "face", face).empty()) continue;
        data.triangles.push_back({own(t.a), own(t.b), own(t.c)});
        data.faces.push_back(face);
        data.material_slots.push_back(slot);
    }
    // Add the vertices that they use.
    for (const std::uint32_t vertex : used) data.vertices.push_back(three(positions, vertex));
    add_attributes(primitive, used, slot, data);
    return data;
}

// Adds the normals and the texture coordinates of the vertices `used`.
void GltfMeshes::add_attributes(const GltfValue& primitive, const std::vector<std::uint32_t>& used, std::uint32_t slot,
                                MeshData& data) {
    const GltfValue attributes = primitive["attributes"], normal = attributes["NORMAL"];
    const std::size_t vertices = buffers_.floats(attributes["POSITION"], "VEC3").size() / 3;
    if (normal.exists()) {
        const std::vector<float>& normals = attribute(normal, "VEC3", vertices);
        for (const std::uint32_t vertex : used) data.normals.push_back(three(normals, vertex));
    }
    // Transform the texture coordinates as the pictures of the material need them, and turn v upward.
    const GltfPlace place = slot == 0 ? GltfPlace{} : materials_[slot - 1].place;
    const GltfValue uv = attributes["TEXCOORD_" + std::to_string(place.uv_set)];
    if (!uv.exists()) {
        if (slot > 0 && materials_[slot - 1].has_pictures)
            warn_once("material " + in_quotes(materials_[slot - 1].name) +
                      " has pictures, but triangles of it have no " + "TEXCOORD_" + std::to_string(place.uv_set));
        return;
    }
    const std::vector<float>& uvs = attribute(uv, "VEC2", vertices);
    for (const std::uint32_t vertex : used) {
        const double u = uvs[2 * vertex], v = uvs[2 * vertex + 1];
        const auto at = [u, v](const std::array<double, 3>& row) { return row[0] * u + row[1] * v + row[2]; };
        data.uvs.push_back({static_cast<float>(at(place.u_of)), static_cast<float>(1 - at(place.v_of))});
    }
}

// Returns the values of an attribute, of which there must be one for each vertex.
const std::vector<float>& GltfMeshes::attribute(const GltfValue& number, const std::string& type,
                                                std::size_t vertices) {
    const std::vector<float>& values = buffers_.floats(number, type);
    const std::size_t count = values.size() / static_cast<std::size_t>(type.back() - '0');
    if (count != vertices)
        number.fail("has " + std::to_string(count) + " values for " + std::to_string(vertices) + " vertices");
    return values;
}

void GltfMeshes::warn_once(const std::string& warning) {
    if (warnings_.insert(warning).second) model_.warnings.push_back(warning);
}

}  // namespace limn
