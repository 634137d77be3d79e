// glTF 2.0, as JSON and binary.
#include <cmath>

#include "formats.h"
#include "gltf_files.h"
#include "limn/image/image.h"
#include "limn/io/image_io.h"
#include "limn/math/math.h"
#include "limn/math/surface.h"
#include "limn/scene/material/dielectric.h"
#include "limn/scene/material/diffuse_light.h"
#include "limn/scene/material/metallic_roughness.h"
#include "limn/scene/material/plastic.h"
#include "limn/scene/material/rough_conductor.h"
#include "limn/scene/scene.h"
#include "limn/scene/texture/image_texture.h"
#include "lowered_material.h"

namespace limn::gltf_test {

using namespace test;

namespace {

// The base colour of the square's material at a point of the square.
Color albedo_at(const Model& model, double x, double y) {
    const auto hit = model.meshes.at(0)->hit({.origin = {x, y, 1}, .direction = {0, 0, -1}});
    REQUIRE(hit);
    const LoweredMaterial lowered(*hit->material);
    const TextureRecord& texture = lowered.texture(lowered.record.albedo);
    if (texture.kind == TextureKind::solid) return texture.color;
    Surface s;
    s.uv = *hit->uv;
    return ImageTexture(lowered.sink.records().images.at(texture.data), {texture.filter, texture.wrap}).value(s);
}

}  // namespace

TEST_CASE("glTF: embedded, outside and binary buffers give the same mesh", "[io][gltf]") {
    const Folder folder;
    folder.write("a b.bin", square_bytes());
    for (const std::string& bytes :
         {kSquare, square_gltf("\"uri\": \"a%20b.bin\", "), glb(square_gltf(""), square_bytes())}) {
        const Model model = load_model(folder.write("a.model", bytes));
        REQUIRE(model.meshes.size() == 1);
        const MeshData& data = model.meshes[0]->data();
        CHECK(data.vertices == std::vector<Float3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
        CHECK(data.triangles == std::vector<Index3>{{0, 1, 2}, {0, 2, 3}});
        CHECK(data.uvs == std::vector<Float2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}});  // v upward
        CHECK(data.material_slots == std::vector<std::uint32_t>{1, 1});
        CHECK(data.normals.empty());
        CHECK(model.materials == std::vector<std::string>{"red"});
        CHECK(model.instances.size() == 1);
        CHECK(model.instances[0].name == "square");
        CHECK(model.faces == 2);
        CHECK(model.vertices == 4);
        CHECK(model.warnings.empty());
        CHECK(distance(albedo_at(model, 0.5, 0.5), {1, 0, 0}) < 1e-12);
    }
}

TEST_CASE("glTF: strips and fans are cut as the specification says", "[io][gltf]") {
    using Triangles = std::vector<Index3>;
    const auto triangles = [](const std::string& text) { return load(text).meshes.at(0)->data().triangles; };
    CHECK(triangles(with("\"indices\": 2", "\"mode\": 5")) == Triangles{{0, 1, 2}, {1, 3, 2}});
    CHECK(triangles(with("\"indices\": 2", "\"mode\": 6")) == Triangles{{0, 1, 2}, {1, 3, 2}});
    CHECK(load(with("\"indices\": 2", "\"mode\": 6")).meshes[0]->data().vertices[2] == Float3{0, 0, 0});
}

TEST_CASE("glTF: interleaved, normalised and sparse accessors are read", "[io][gltf]") {
    // Positions of 16 bits in steps of 8 bytes, as KHR_mesh_quantization has them; the rest as before.
    std::string bytes;
    for (const unsigned corner : {0U, 1U, 3U, 2U})
        bytes += little((corner & 1) * 65535U, 2) + little((corner >> 1) * 65535U, 2) + little(0, 2) + little(7, 2);
    bytes += std::string(16, '\0') + square_bytes().substr(48);
    const std::string whole = square_gltf("\"uri\": \"" + data_uri(bytes) + "\", ");
    const std::string quantized =
        replaced(replaced(whole, "\"byteLength\": 48", "\"byteLength\": 48, \"byteStride\": 8"),
                 R"("componentType": 5126, "count": 4, "type": "VEC3")",
                 R"("componentType": 5123, "normalized": true, "count": 4, "type": "VEC3")");
    CHECK(load(quantized).meshes.at(0)->data().vertices ==
          std::vector<Float3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});

    // Vertex 2, the third index, moves to the first one's place in the view of texture coordinates: (0, 1, 1).
    const std::string sparse = replaced(
        kSquare, "\"type\": \"VEC3\"",
        R"("type": "VEC3", "sparse": {"count": 1, "indices": {"bufferView": 2, "byteOffset": 4, "componentType": 5123},
        "values": {"bufferView": 1}})");
    CHECK(load(sparse).meshes.at(0)->data().vertices ==
          std::vector<Float3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 1}, {0, 1, 0}});
}

TEST_CASE("glTF: nodes place meshes, cameras and lights", "[io][gltf]") {
    const std::string nodes = R"("nodes": [
{"children": [1, 2], "translation": [10, 0, 0], "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476]},
{"mesh": 0, "scale": [2, 2, 2], "name": "first"},
{"mesh": 0, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,5,0,1], "camera": 0, "name": "eye",
 "extensions": {"KHR_lights_punctual": {"light": 0}}}],
"cameras": [{"type": "perspective", "perspective": {"yfov": 1, "aspectRatio": 1.5, "znear": 0.1}}],
"extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "intensity": 3, "color": [1, 0.5, 0],
 "spot": {"outerConeAngle": 0.5}}]}})";
    const Model model = load(with(R"("nodes": [{"mesh": 0, "name": "square"}])", nodes));
    CHECK(model.meshes.size() == 1);
    REQUIRE(model.instances.size() == 2);
    const auto near = [](const Point3& p, const Point3& q) { return length(p - q) < 1e-12; };
    CHECK(model.instances[0].name == "first");
    CHECK(near(transform_point(model.instances[0].world_from_mesh, {1, 0, 0}), {10, 2, 0}));
    CHECK(near(transform_point(model.instances[1].world_from_mesh, {1, 0, 0}), {5, 1, 0}));
    Scene scene;
    scene.add(model);
    CHECK(scene.objects().size() == 2);

    REQUIRE(model.cameras.size() == 1);
    const ModelCamera& camera = model.cameras[0];
    CHECK(camera.name == "eye");
    CHECK(near(camera.camera.look_from, {5, 0, 0}));
    CHECK(near(camera.camera.look_at, {5, 0, -1}));
    CHECK(length(camera.camera.up - Vec3{-1, 0, 0}) < 1e-12);
    CHECK(camera.camera.vertical_fov == Approx(180 / kPi));
    CHECK(camera.camera.aspect_ratio == 1.5);
    CHECK(camera.camera.projection == Projection::perspective);

    REQUIRE(model.lights.size() == 1);
    const ModelLight& light = model.lights[0];
    CHECK(light.kind == ModelLight::Kind::spot);
    CHECK(light.intensity == Color{3, 1.5, 0});
    CHECK(near(light.position, {5, 0, 0}));
    CHECK(length(light.direction - Vec3{0, 0, -1}) < 1e-12);
    CHECK(light.outer_cone_angle == Approx(90 / kPi));
}

TEST_CASE("glTF: what a node with a singular matrix holds is left out, each with a warning", "[io][gltf]") {
    for (const char* type : {"point", "spot", "directional"}) {
        const std::string nodes = R"("nodes": [{"children": [1, 2, 3, 4]}, {"mesh": 0},
{"mesh": 0, "scale": [0, 0, 0]}, {"camera": 0, "scale": [1, 1, 0]},
{"scale": [0, 0, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
"cameras": [{"type": "perspective", "perspective": {"yfov": 1}}],
"extensions": {"KHR_lights_punctual": {"lights": [{"type": ")" +
                                  std::string(type) + R"("}]}})";
        const Model model = load(with(R"("nodes": [{"mesh": 0, "name": "square"}])", nodes));
        CHECK(model.instances.size() == 1);
        CHECK(model.cameras.empty());
        CHECK(model.lights.empty());
        REQUIRE(model.warnings.size() == 3);
        for (std::size_t i = 0; i < 3; ++i)
            CHECK(model.warnings[i] ==
                  "nodes[" + std::to_string(i + 2) + "]: its matrix is singular, and what it holds left out");
    }
}

TEST_CASE("glTF: a rotation that is rounded turns, and does not scale", "[io][gltf]") {
    const Model model = load(with("\"mesh\": 0", "\"mesh\": 0, \"rotation\": [0, 0, 0.71, 0.71]"));
    const Transform& m = model.instances.at(0).world_from_mesh;
    CHECK(length(transform_vector(m, {1, 0, 0}) - Vec3{0, 1, 0}) < 1e-15);
}

TEST_CASE("glTF: positions that several primitives share count once", "[io][gltf]") {
    const std::string primitive = R"({"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0})";
    const Model model = load(with(primitive, primitive + ", " + primitive));
    CHECK(model.meshes.size() == 2);
    CHECK(model.vertices == 4);
}

TEST_CASE("glTF: an orthographic camera keeps its height", "[io][gltf]") {
    const Model model = load(with(R"("nodes": [{"mesh": 0,)", R"("cameras": [{"type": "orthographic", "name": "plan",
"orthographic": {"xmag": 2, "ymag": 1.5, "zfar": 9, "znear": 0}}], "nodes": [{"mesh": 0, "camera": 0,)"));
    REQUIRE(model.cameras.size() == 1);
    CHECK(model.cameras[0].camera.projection == Projection::orthographic);
    CHECK(model.cameras[0].camera.view_height == 3.0);
    CHECK(model.cameras[0].camera.aspect_ratio == Approx(4.0 / 3));
    CHECK(model.cameras[0].name == "square");
}

TEST_CASE("glTF: metallicFactor and emissiveFactor decide which of limn's materials a material becomes", "[io][gltf]") {
    CHECK(is_of<Plastic>(load(kSquare)));
    CHECK(is_of<RoughConductor>(load(with_material(R"("name": "default")"))));  // metallicFactor is 1 unless stated
    CHECK(is_of<MetallicRoughness>(load(with_material(R"("pbrMetallicRoughness": {"metallicFactor": 0.6})"))));
    CHECK(is_of<DiffuseLight>(load(with_material(R"("emissiveFactor": [1, 1, 0])"))));
    const Model lamp = load(with_material(
        R"("emissiveFactor": [1, 0.5, 0], "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4}})"));
    CHECK(lamp.meshes[0]->materials()[1]->emitted({}) == Color{4, 2, 0});
    Model model = load(kSquare);
    model.replace_material("red", std::make_shared<Dielectric>(1.5));
    CHECK(is_of<Dielectric>(model));
}

TEST_CASE("glTF: pictures of each format lie as they should in all three kinds of places", "[io][gltf]") {
    for (const std::string& suffix : written_suffixes()) {
        const Folder folder;
        const std::string picture = four_pixels(folder, suffix), size = std::to_string(picture.size());
        const std::string in_view = replaced(
            with_texture(R"("bufferView": 3, "mimeType": "image/png")"), R"("byteOffset": 80, "byteLength": 12}])",
            R"("byteOffset": 80, "byteLength": 12}, {"buffer": 1, "byteLength": )" + size + "}]");
        const std::string second_buffer = in_view.substr(0, in_view.rfind("]}")) + ", {\"uri\": \"" +
                                          data_uri(picture) + "\", \"byteLength\": " + size + "}]}";
        for (const std::string& text :
             {with_texture("\"uri\": \"four" + suffix + "\""),
              with_texture("\"uri\": \"" + data_uri(picture, "image/png") + "\""), second_buffer}) {
            CAPTURE(suffix, text);
            const Model model = load_model(folder.write("a.gltf", text));
            CHECK(model.warnings.empty());
            CHECK(distance(albedo_at(model, 0.25, 0.75), {1, 0, 0}) < 1e-6);
            CHECK(distance(albedo_at(model, 0.75, 0.75), {0, 1, 0}) < 1e-6);
            CHECK(distance(albedo_at(model, 0.25, 0.25), {0, 0, 1}) < 1e-6);
            CHECK(distance(albedo_at(model, 0.75, 0.25), {1, 1, 1}) < 1e-6);
        }
    }
}

TEST_CASE("glTF: colours are linear in a picture of floats, and sRGB in others", "[io][gltf]") {
    const Color color{0.5, 0.25, 0.75};
    for (const std::string& suffix : written_suffixes()) {
        CAPTURE(suffix);
        const Folder folder;
        save_image(Image(1, 1, color), folder.path("a" + suffix));
        const std::string inside = data_uri(folder.read("a" + suffix));
        for (const std::string& uri : {"a" + suffix, inside}) {
            const Model model = load_model(folder.write("a.gltf", with_texture("\"uri\": \"" + uri + "\"")));
            CHECK(distance(albedo_at(model, 0.5, 0.5), color) < 0.01);
        }
    }
}

TEST_CASE("glTF: a base colour multiplies its picture, and a transform moves it", "[io][gltf]") {
    const Folder folder;
    four_pixels(folder);
    const std::string text = with_texture("\"uri\": \"four.png\"", R"("pbrMetallicRoughness": {"metallicFactor": 0,
"baseColorFactor": [0.5, 0.25, 1, 1], "baseColorTexture": {"index": 0,
"extensions": {"KHR_texture_transform": {"offset": [0.5, 0]}}}})");
    const Model model = load_model(folder.write("a.gltf", text));
    CHECK(distance(albedo_at(model, 0.75, 0.75), {0.5, 0, 0}) < 1e-6);  // half a picture to the left, repeated
    CHECK(distance(albedo_at(model, 0.25, 0.25), {0.5, 0.25, 1}) < 1e-6);
}

TEST_CASE("glTF: a picture that cannot be read is named, and the factor stands for it", "[io][gltf]") {
    const Folder folder;
    const std::string text = with_texture("\"uri\": \"none.png\"");
    const Model model = load_model(folder.write("a.gltf", text));
    REQUIRE(model.warnings.size() == 1);
    CHECK(model.warnings[0] == folder.path("none.png") + ": there is no such file");
    CHECK(distance(albedo_at(model, 0.5, 0.5), {1, 1, 1}) < 1e-12);
    CHECK(load_model(folder.path("a.gltf"), {.textures = false}).warnings.empty());
    const Model damaged = load(with_texture("\"uri\": \"data:image/png;base64,AAAA\""));
    REQUIRE(damaged.warnings.size() == 1);
    CHECK(damaged.warnings[0].find("a.model: images[0]: is not a readable image") != std::string::npos);
}

TEST_CASE("glTF: each primitive is a mesh of the vertices that it uses", "[io][gltf]") {
    const std::string text = with(R"("indices": 2, "material": 0})",
                                  R"("indices": 3, "material": 0}, {"attributes": {"POSITION": 0}, "indices": 4})");
    const std::string accessors = replaced(text, R"("count": 6, "type": "SCALAR"})",
                                           R"("count": 6, "type": "SCALAR"},
{"bufferView": 2, "componentType": 5123, "count": 3, "type": "SCALAR"},
{"bufferView": 2, "byteOffset": 6, "componentType": 5123, "count": 3, "type": "SCALAR"})");
    const Model model = load(accessors);
    REQUIRE(model.meshes.size() == 2);
    CHECK(model.instances.size() == 2);
    CHECK(model.meshes[0]->data().vertices.size() == 3);
    CHECK(model.meshes[1]->data().vertices.size() == 3);
    CHECK(model.meshes[1]->data().uvs.empty());
    CHECK(model.meshes[1]->data().material_slots[0] == 0);
    CHECK(model.meshes[1]->face(0) == 1);  // faces of the file
}

}  // namespace limn::gltf_test
