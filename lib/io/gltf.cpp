// Reads glTF 2.0 (Khronos, 2021): JSON with separate files, or one binary file. Numbers of sections refer to its
// specification.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "geometry/ray_frame.h"
#include "io/bytes.h"
#include "io/gltf_meshes.h"
#include "io/text_lines.h"
#include "limn/math/math.h"

namespace limn {

namespace {

// The contents of a glTF file.
struct Parts {
    std::string_view json;
    std::span<const std::byte> chunk;  // the binary chunk of a binary file, or empty
};

// Splits a file into its parts. A binary file (4.4) is a header of 12 bytes and chunks. A chunk is a length, a type and
// data. The first chunk is the JSON. A file without the mark of a binary one is JSON as a whole. \throws Fault
Parts divide(std::string_view bytes) {
    if (!bytes.starts_with("glTF")) return {bytes, {}};
    // Check the header.
    constexpr std::uint64_t kJson = 0x4e4f534a, kBinary = 0x004e4942;
    Cursor file(std::as_bytes(std::span(bytes)), "breaks off within its header");
    file.take(4);
    const std::uint64_t version = file.little(4), size = file.little(4);
    demand(version == 2, "is a binary glTF of version " + std::to_string(version) + "; version 2 is read");
    demand(size >= 12 && size <= bytes.size(),
           "breaks off: it states " + std::to_string(size) + " bytes, and has " + std::to_string(bytes.size()));
    // Take the JSON and the first binary chunk; ignore other chunks.
    file = Cursor(file.rest().first(size - 12));
    Parts parts;
    for (bool is_first = true; !file.rest().empty(); is_first = false) {
        demand(file.rest().size() >= 8, "breaks off before a chunk");
        const std::uint64_t length = file.little(4), type = file.little(4);
        demand(length <= file.rest().size(), "breaks off: a chunk states " + std::to_string(length) +
                                                 " bytes, and there are " + std::to_string(file.rest().size()));
        const std::span<const std::byte> data = file.take(length);
        demand(!is_first || type == kJson, "its first chunk is not JSON");
        if (is_first) parts.json = text_of(data);
        if (type == kBinary && parts.chunk.empty()) parts.chunk = data;
    }
    demand(!parts.json.empty(), "holds no JSON");
    return parts;
}

// Parses the JSON of a file. \throws Fault with the reason and the position if it is malformed
nlohmann::json parse(std::string_view text) {
    try {
        return nlohmann::json::parse(text);
    } catch (const nlohmann::json::exception& error) {
        const std::string what = error.what();  // "[json.exception...] parse error at line 1, column 2: ..."
        throw Fault{"is no JSON: " + what.substr(std::min(what.size(), what.find("] ") + 2), 200)};
    }
}

// Reads the scene of a glTF into a Model. All errors are FileErrors that name the file and the place in the JSON.
class GltfReader {
public:
    GltfReader(const nlohmann::json& root, std::span<const std::byte> chunk, const std::string& path,
               const ModelOptions& options, Model& model)
        : document_(root, path),
          path_(path),
          options_(options),
          model_(model),
          buffers_(document_, chunk, path, model) {}

    void read() {
        const std::string version = document_["asset"]["version"].text_or("");
        if (!version.starts_with("2.")) document_["asset"]["version"].fail("is not 2.0, which is read");
        if (document_["asset"]["minVersion"].text_or("2.0") != "2.0")
            document_["asset"]["minVersion"].fail("is not 2.0, which is read");
        check_extensions();
        materials_ = load_gltf_materials(document_, buffers_, path_, options_, model_);
        GltfMeshes meshes(document_, buffers_, materials_, options_, model_);
        meshes_ = &meshes;
        visit_all();
        if (document_["animations"].size() > 0) model_.warnings.emplace_back("animations are not used");
        if (document_["skins"].size() > 0) model_.warnings.emplace_back("skins are not used: meshes stand unposed");
        if (model_.instances.empty())
            document_.fail(model_.faces == 0 ? "has no usable face: its scene holds no triangles"
                                             : "has no usable face: all " + std::to_string(model_.faces) +
                                                   " have no area, or stand nowhere");
    }

private:
    // A node that is still to be visited.
    struct Visit {
        GltfValue node;
        Transform world_from_parent;
    };

    // Throws if an extension is required that limn does not read. Warns of others that limn does not use.
    void check_extensions() {
        static const std::set<std::string> known{"KHR_lights_punctual",   "KHR_materials_emissive_strength",
                                                 "KHR_materials_ior",     "KHR_materials_transmission",
                                                 "KHR_mesh_quantization", "KHR_texture_transform"};
        const GltfValue required = document_["extensionsRequired"], used = document_["extensionsUsed"];
        for (std::size_t i = 0; i < required.size(); ++i) {
            const std::string name = required[i].text_or("");
            if (!known.contains(name)) required[i].fail("the extension " + shortened(name) + " is not read");
        }
        for (std::size_t i = 0; i < used.size(); ++i) {
            const std::string name = used[i].text_or("");
            if (known.contains(name)) continue;
            const std::string instead = name == "KHR_materials_unlit" ? ": its materials are lit like the others" : "";
            model_.warnings.push_back("the extension " + shortened(name) + " is not used" + instead);
        }
    }

    // Visits the nodes of the default scene and their children. Without a default scene, takes the first scene. Without
    // any scene, starts at all nodes without a parent.
    void visit_all() {
        // Find the root nodes.
        const GltfValue nodes = document_["nodes"], scenes = document_["scenes"], number = document_["scene"];
        if (number.exists()) {
            visit_children(number.in(scenes)["nodes"], {});
        } else if (scenes.size() > 0) {
            visit_children(scenes[0]["nodes"], {});
        } else {
            std::set<std::uint64_t> children;
            for (std::size_t i = 0; i < nodes.size(); ++i)
                for (std::size_t k = 0; k < nodes[i]["children"].size(); ++k)
                    children.insert(nodes[i]["children"][k].natural());
            for (std::size_t i = nodes.size(); i-- > 0;)
                if (!children.contains(i)) open_.push_back({nodes[i], {}});
        }
        // Visit the nodes depth first.
        while (!open_.empty()) {
            const Visit next = open_.back();
            open_.pop_back();
            if (!visited_.insert(next.node.place()).second)
                next.node.fail("has two parents, or is among its own children");
            visit(next);
        }
    }

    // Schedules the visits of nodes given by their numbers. `open_` is a stack, so the last one is pushed first.
    void visit_children(const GltfValue& numbers, const Transform& world_from_parent) {
        for (std::size_t i = numbers.size(); i-- > 0;)
            open_.push_back({numbers[i].in(document_["nodes"]), world_from_parent});
    }

    // Adds the mesh, the camera and the light of a node to the model, and schedules the visits of its children.
    void visit(const Visit& visit) {
        const auto& [node, world_from_parent] = visit;
        const Transform world_from_node = world_from_parent * transform_of(node);
        if (!is_finite(world_from_node)) node.fail("its matrix is not finite");
        const std::string name = node["name"].text_or("");
        const GltfValue mesh = node["mesh"], camera = node["camera"],
                        light = node["extensions"]["KHR_lights_punctual"]["light"];
        const bool is_usable = can_be_inverted(world_from_node);
        if (!is_usable && (mesh.exists() || camera.exists() || light.exists()))
            model_.warnings.push_back(node.place() + ": its matrix is singular, and what it holds left out");
        if (mesh.exists()) {
            // Read the mesh even if the node is left out, so that its faces are counted.
            const std::vector<std::size_t>& parts = meshes_->get(mesh);
            for (const std::size_t part : parts)
                if (is_usable) model_.instances.push_back({part, world_from_node, name});
        }
        if (camera.exists() && is_usable) add_camera(camera.in(document_["cameras"]), world_from_node, name);
        if (light.exists() && is_usable)
            add_light(light.in(document_["extensions"]["KHR_lights_punctual"]["lights"]), world_from_node, name);
        visit_children(node["children"], world_from_node);
    }

    // Returns the rotation of a node, scaled to length 1, because files store it rounded. Throws if its length differs
    // from 1 by 0.01 or more.
    static std::vector<double> unit_quaternion(const GltfValue& rotation) {
        std::vector<double> q = rotation.numbers_or({0, 0, 0, 1});
        const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
        if (!(std::abs(length - 1) < 0.01)) rotation.fail("is no unit quaternion");
        for (double& component : q) component /= length;
        return q;
    }

    // Returns the transform from the space of a node to that of its parent.
    static Transform transform_of(const GltfValue& node) {
        Transform m;
        // Read a matrix, which is stored column by column.
        if (node["matrix"].exists()) {
            for (const char* other : {"translation", "rotation", "scale"})
                if (node[other].exists()) node[other].fail("stands beside a matrix");
            const std::vector<double> columns = node["matrix"].numbers_or(std::vector<double>(16));
            if (columns[3] != 0 || columns[7] != 0 || columns[11] != 0 || columns[15] != 1)
                node["matrix"].fail("its last row is not 0 0 0 1");
            for (std::size_t row = 0; row < 3; ++row)
                for (std::size_t column = 0; column < 4; ++column) m.rows[row][column] = columns[4 * column + row];
            return m;
        }
        // Otherwise, compose translation, rotation and scale.
        const std::vector<double> t = node["translation"].numbers_or({0, 0, 0}), q = unit_quaternion(node["rotation"]),
                                  s = node["scale"].numbers_or({1, 1, 1});
        const double x = q[0], y = q[1], z = q[2], w = q[3];
        const double rotation[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                                       {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                                       {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}};
        for (std::size_t row = 0; row < 3; ++row) {
            for (std::size_t column = 0; column < 3; ++column) m.rows[row][column] = rotation[row][column] * s[column];
            m.rows[row][3] = t[row];
        }
        return m;
    }

    static bool can_be_inverted(const Transform& m) {
        try {
            inverse(m);
            return !is_singular(m);
        } catch (const ArgumentError&) {
            return false;
        }
    }

    // Adds a camera to the model. `m` is the transform from the space of its node to the world.
    void add_camera(const GltfValue& description, const Transform& m, const std::string& node_name) {
        // Set the name and the position: a camera looks along -z, with +y up.
        ModelCamera camera;
        camera.name = node_name.empty() ? description["name"].text_or(description.place()) : node_name;
        camera.camera.look_from = transform_point(m, {0, 0, 0});
        camera.camera.look_at = transform_point(m, {0, 0, -1});
        camera.camera.up = transform_vector(m, {0, 1, 0});
        // Set the projection.
        const std::string type = description["type"].text_or("perspective");
        if (type != "perspective" && type != "orthographic")
            description["type"].fail("is neither perspective nor orthographic");
        if (type == "orthographic") {
            const GltfValue frame = description["orthographic"];
            const double half_width = std::abs(frame["xmag"].number()), half_height = std::abs(frame["ymag"].number());
            if (!(half_width > 0 && half_height > 0)) frame.fail("its xmag or ymag is 0");
            camera.camera.projection = Projection::orthographic;
            camera.camera.view_height = 2 * half_height;
            camera.camera.aspect_ratio = half_width / half_height;
        } else {
            const GltfValue perspective = description["perspective"], angle = perspective["yfov"];
            camera.camera.vertical_fov = angle.number() * 180 / kPi;
            if (!(camera.camera.vertical_fov > 0)) angle.fail("is not above 0");
            if (!(camera.camera.vertical_fov < 180)) {
                model_.warnings.push_back(angle.place() + " is not below pi, and the camera left out");
                return;
            }
            const GltfValue ratio = perspective["aspectRatio"];
            if (ratio.exists()) camera.camera.aspect_ratio = ratio.number();
            if (!(camera.camera.aspect_ratio.value_or(1) > 0)) ratio.fail("is not above 0");
        }
        model_.cameras.push_back(camera);
    }

    // Adds a light of KHR_lights_punctual to the model. `m` is the transform from the space of its node to the world.
    void add_light(const GltfValue& description, const Transform& m, const std::string& node_name) {
        // Set the name and the kind.
        const std::string type = description["type"].text_or("");
        ModelLight light;
        light.name = node_name.empty() ? description["name"].text_or(description.place()) : node_name;
        if (type != "point" && type != "spot" && type != "directional")
            description["type"].fail("is none of point, spot and directional");
        light.kind = type == "point"  ? ModelLight::Kind::point
                     : type == "spot" ? ModelLight::Kind::spot
                                      : ModelLight::Kind::directional;
        // Set the intensity, the position and the cone. A light shines along -z.
        const std::vector<double> color = description["color"].numbers_or({1, 1, 1});
        light.intensity = description["intensity"].number_or(1) * Color{color[0], color[1], color[2]};
        light.position = transform_point(m, {0, 0, 0});
        light.direction = normalize(transform_vector(m, {0, 0, -1}));
        const GltfValue spot = description["spot"];
        light.inner_cone_angle = spot["innerConeAngle"].number_or(0) * 180 / kPi;
        light.outer_cone_angle = spot["outerConeAngle"].number_or(kPi / 4) * 180 / kPi;
        // Check the values.
        if (!is_finite(light.intensity) || !(std::min({color[0], color[1], color[2]}) >= 0) ||
            !(description["intensity"].number_or(1) >= 0))
            description.fail("has an intensity or a color that is negative or infinite");
        if (!is_finite(light.direction)) description.fail("is in a node that leaves it no direction");
        if (!(light.inner_cone_angle >= 0 && light.inner_cone_angle <= light.outer_cone_angle &&
              light.outer_cone_angle > 0 && light.outer_cone_angle <= 90))
            spot.fail("does not have 0 <= innerConeAngle <= outerConeAngle <= pi / 2");
        model_.lights.push_back(light);
    }

    GltfValue document_;
    const std::string& path_;
    const ModelOptions& options_;
    Model& model_;
    GltfBuffers buffers_;
    std::vector<GltfMaterial> materials_;
    GltfMeshes* meshes_ = nullptr;
    std::vector<Visit> open_;        // a stack
    std::set<std::string> visited_;  // GltfValue::place() of the nodes
};

}  // namespace

Model read_gltf(std::string_view bytes, const std::string& path, const ModelOptions& options) {
    Model model;
    model.files = {path};
    const Parts parts = divide(bytes);
    const nlohmann::json root = parse(parts.json);
    GltfReader(root, parts.chunk, path, options, model).read();
    return model;
}

}  // namespace limn
