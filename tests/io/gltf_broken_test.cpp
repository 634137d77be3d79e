// Damaged and odd glTF files.
#include <limits>

#include "gltf_files.h"

namespace limn::gltf_broken_test {

using namespace test;

namespace {

// The square with other bytes behind it.
std::string of_bytes(const std::string& bytes) { return square_gltf("\"uri\": \"" + data_uri(bytes) + "\", "); }

std::string with_bytes(std::size_t place, const std::string& bytes) {
    return of_bytes(square_bytes().replace(place, bytes.size(), bytes));
}

// A camera beside the square.
std::string with_camera(const std::string& members) {
    return with("\"nodes\": [{", "\"cameras\": [{" + members + "}], \"nodes\": [{\"camera\": 0, ");
}

const std::string kPositions = R"({"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"})";

}  // namespace

TEST_CASE("glTF: every broken or odd JSON has its verdict", "[io][gltf]") {
    const std::vector<ModelVerdict> verdicts = {
        {"whole", kSquare, 2, ""},
        {"breaks off", kSquare.substr(0, kSquare.size() - 1), 0, "is no JSON: parse error at line"},
        {"a comma too many", with("\"scene\": 0,", "\"scene\": 0,,"), 0, "is no JSON: parse error at line 1"},
        {"no UTF-8", with("square", "\xff\xfe"), 0, "is no JSON: parse error at line 2"},
        {"no version", with(R"("version": "2.0")", ""), 0, "asset.version: is not 2.0"},
        {"version 1", with("2.0", "1.0"), 0, "asset.version: is not 2.0"},
        {"a version that is a number", with("\"2.0\"", "2.0"), 0, "asset.version: is not a text"},
        {"later minimal version", with("\"2.0\"", R"("2.1", "minVersion": "2.1")"), 0, "asset.minVersion: is not 2.0"},
        {"minimal version 2.0", with("\"2.0\"", R"("2.1", "minVersion": "2.0")"), 2, ""},
        {"asset is an array", with(R"({"version": "2.0"})", "[]"), 0, "asset: is not an object"},
        {"scene out of range", with("\"scene\": 0", "\"scene\": 1"), 0, "scene: is 1, but there are 1 scenes"},
        {"scene is a text", with("\"scene\": 0", "\"scene\": \"0\""), 0, "scene: is not a number"},
        {"no scene stated", with("\"scene\": 0, ", ""), 2, ""},
        {"no scenes", with(R"("scene": 0, "scenes": [{"nodes": [0]}],)", ""), 2, ""},
        {"scenes is an object", with(R"([{"nodes": [0]}])", "{}"), 0, "scenes: is not an array"},
        {"empty scene", with(R"("nodes": [0])", ""), 0, "has no usable face: its scene holds no triangles"},
        {"node out of range", with(R"("nodes": [0])", R"("nodes": [7])"), 0,
         "scenes[0].nodes[0]: is 7, but there are 1 nodes"},
        {"negative node", with(R"("nodes": [0])", R"("nodes": [-1])"), 0, "scenes[0].nodes[0]: is not a number of"},
        {"half a node", with(R"("nodes": [0])", R"("nodes": [0.5])"), 0, "scenes[0].nodes[0]: is not a number of"},
        {"a node twice", with(R"("nodes": [0])", R"("nodes": [0, 0])"), 0, "nodes[0]: has two parents"},
        {"a node in itself", with("\"mesh\": 0", "\"mesh\": 0, \"children\": [0]"), 0, "among its own children"},
        {"a ring of nodes", with("{\"mesh\": 0", "{\"children\": [1]}, {\"children\": [0], \"mesh\": 0"), 0,
         "nodes[0]: has two parents, or is among its own children"},
        {"a ring of nodes without scenes",
         replaced(with(R"("scene": 0, "scenes": [{"nodes": [0]}],)", ""), "{\"mesh\": 0",
                  "{\"children\": [1]}, {\"children\": [0], \"mesh\": 0"),
         0, "has no usable face"},
        {"mesh out of range", with("\"mesh\": 0", "\"mesh\": 1"), 0, "nodes[0].mesh: is 1, but there are 1 meshes"},
        {"matrix of nine", with("\"mesh\": 0", "\"mesh\": 0, \"matrix\": [1,0,0,0,1,0,0,0,1]"), 0,
         "nodes[0].matrix: must be 16 numbers"},
        {"matrix of words", with("\"mesh\": 0", "\"mesh\": 0, \"translation\": [1,\"a\",0]"), 0,
         "nodes[0].translation[1]: is not a number"},
        {"matrix too large", with("\"mesh\": 0", "\"mesh\": 0, \"scale\": [1e999,1,1]"), 0, "is no JSON"},
        {"scales that overflow",
         replaced(
             with("{\"mesh\": 0", "{\"scale\": [1e300,1,1], \"children\": [1]}, {\"scale\": [1e300,1,1], \"mesh\": 0"),
             "\"scene\": 0", "\"scene\": 0"),
         0, "nodes[1]: its matrix is not finite"},
        {"matrix beside a scale",
         with("\"mesh\": 0", "\"mesh\": 0, \"scale\": [1,1,1], \"matrix\": [1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]"), 0,
         "nodes[0].scale: stands beside a matrix"},
        {"projective matrix", with("\"mesh\": 0", "\"mesh\": 0, \"matrix\": [1,0,0,1,0,1,0,0,0,0,1,0,0,0,0,1]"), 0,
         "nodes[0].matrix: its last row is not 0 0 0 1"},
        {"rotation of zeros", with("\"mesh\": 0", "\"mesh\": 0, \"rotation\": [0,0,0,0]"), 0,
         "nodes[0].rotation: is no unit quaternion"},
        {"rotation that is no unit quaternion", with("\"mesh\": 0", "\"mesh\": 0, \"rotation\": [0,0,2,2]"), 0,
         "nodes[0].rotation: is no unit quaternion"},
        {"a byte order mark", "\xef\xbb\xbf" + kSquare, 2, ""},
        {"singular matrix", with("\"mesh\": 0", "\"mesh\": 0, \"scale\": [0,1,1]"), 0,
         "has no usable face: all 2 have no area, or stand nowhere"},
        {"camera out of range", with("\"mesh\": 0", "\"mesh\": 0, \"camera\": 0"), 0, "but there are 0 cameras"},
        {"unknown camera", with_camera(R"("type": "fisheye")"), 0,
         "cameras[0].type: is neither perspective nor orthographic"},
        {"camera without a type", with_camera(R"("perspective": {"yfov": 1})"), 2, ""},
        {"angle of view above pi", with_camera(R"("type": "perspective", "perspective": {"yfov": 4})"), 2,
         "cameras[0].perspective.yfov is not below pi, and the camera left out"},
        {"negative angle of view", with_camera(R"("type": "perspective", "perspective": {"yfov": -1})"), 0,
         "cameras[0].perspective.yfov: is not above 0"},
        {"magnification 0", with_camera(R"("type": "orthographic", "orthographic": {"xmag": 0, "ymag": 1})"), 0,
         "cameras[0].orthographic: its xmag or ymag is 0"},
        {"negative magnification", with_camera(R"("type": "orthographic", "orthographic": {"xmag": -1, "ymag": 1})"), 2,
         ""},
        {"aspect ratio 0", with_camera(R"("type": "perspective", "perspective": {"yfov": 1, "aspectRatio": 0})"), 0,
         "cameras[0].perspective.aspectRatio: is not above 0"},
        {"aspect ratio -1", with_camera(R"("type": "perspective", "perspective": {"yfov": 1, "aspectRatio": -1})"), 0,
         "cameras[0].perspective.aspectRatio: is not above 0"},
        {"light out of range", with("\"mesh\": 0", R"("mesh": 0, "extensions": {"KHR_lights_punctual": {"light": 0}})"),
         0, "nodes[0].extensions.KHR_lights_punctual.light: is 0, but there are 0 "},
        {"unknown extension required", with("\"scene\": 0", R"("extensionsRequired": ["EXT_meshopt_compression"])"), 0,
         "extensionsRequired[0]: the extension EXT_meshopt_compression is not read"},
        {"unfollowed extension of materials required",
         with("\"scene\": 0", R"("extensionsRequired": ["KHR_materials_ior", "KHR_materials_sheen"])"), 0,
         "extensionsRequired[1]: the extension KHR_materials_sheen is not read"},
        {"extension with control characters", with("\"scene\": 0", R"("extensionsUsed": ["EXT_\u001b[31m\nforged"])"),
         2, "the extension EXT_?[31m?forged is not used"},
        {"unlit materials required", with("\"scene\": 0", R"("extensionsRequired": ["KHR_materials_unlit"])"), 0,
         "extensionsRequired[0]: the extension KHR_materials_unlit is not read"},
        {"followed extensions required",
         with("\"scene\": 0", R"("extensionsRequired": ["KHR_materials_ior", "KHR_materials_transmission"])"), 2, ""},
        {"unknown extension used", with("\"scene\": 0", R"("extensionsUsed": ["EXT_what"])"), 2,
         "the extension EXT_what is not used"},
        {"unlit materials used", with("\"scene\": 0", R"("extensionsUsed": ["KHR_materials_unlit"])"), 2,
         "the extension KHR_materials_unlit is not used: its materials are lit like the others"},
        {"animation", with("\"scene\": 0", R"("animations": [{}])"), 2, "animations are not used"},
        {"skin", with("\"scene\": 0", R"("skins": [{}])"), 2, "skins are not used"},
    };
    CHECK(verdicts.size() >= 30);
    check_verdicts(verdicts, ".gltf");
}

TEST_CASE("glTF: every broken or odd mesh, accessor and buffer has its verdict", "[io][gltf]") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<ModelVerdict> verdicts = {
        {"no primitives", with("primitives", "primitive"), 0, "its scene holds no triangles"},
        {"points", with("\"indices\": 2", "\"mode\": 0"), 0, "its scene holds no triangles"},
        {"unknown mode", with("\"indices\": 2", "\"mode\": 7"), 0, "meshes[0].primitives[0].mode: is none of 0 to 6"},
        {"strip", with("\"indices\": 2", "\"mode\": 5"), 2, ""},
        {"fan", with("\"indices\": 2", "\"mode\": 6"), 2, ""},
        {"Draco", with("\"indices\": 2", R"("extensions": {"KHR_draco_mesh_compression": {}})"), 0,
         "is packed by KHR_draco_mesh_compression"},
        {"no positions", with("POSITION", "POSITIONS"), 0, "its scene holds no triangles"},
        {"accessor out of range", with("\"POSITION\": 0", "\"POSITION\": 3"), 0,
         "meshes[0].primitives[0].attributes.POSITION: is 3, but there are 3 accessors"},
        {"positions of two numbers", with("\"POSITION\": 0", "\"POSITION\": 1"), 0, "accessors[1].type: is not VEC3"},
        {"texture coordinates of three numbers", with("\"TEXCOORD_0\": 1", "\"TEXCOORD_0\": 0"), 0, "is not VEC2"},
        {"fewer texture coordinates than vertices",
         with(R"("bufferView": 1, "componentType": 5126, "count": 4)",
              R"("bufferView": 1, "componentType": 5126, "count": 3)"),
         0, "TEXCOORD_0: has 3 values for 4 vertices"},
        {"indices of positions", with("\"indices\": 2", "\"indices\": 0"), 0, "are not the unsigned integers"},
        {"material out of range", with("\"material\": 0", "\"material\": 1"), 0, "but there are 1 materials"},
        {"index out of range", with_bytes(90, little(4, 2)), 0, "indices: index 5 refers to vertex 4, but there are 4"},
        {"index that ends strips", with_bytes(90, little(0xffff, 2)), 0, "index 5 refers to vertex 65535"},
        {"five indices", with("\"count\": 6", "\"count\": 5"), 1, ""},
        {"two indices", with("\"count\": 6", "\"count\": 2"), 0, "its scene holds no triangles"},
        {"count 0", with("\"count\": 6", "\"count\": 0"), 0, "accessors[2].count: is 0"},
        {"count one too many", with("\"count\": 6", "\"count\": 7"), 0,
         "accessors[2]: reaches to byte 14 of its view, which has 12"},
        {"count that wraps", with("\"count\": 6", "\"count\": 9007199254740992"), 0, "accessors[2]: reaches to byte"},
        {"count beyond all numbers", with("\"count\": 6", "\"count\": 18446744073709551615"), 0, "is not a number of"},
        {"accessor offset too large", with(kPositions, replaced(kPositions, "5126", "5126, \"byteOffset\": 4")), 0,
         "accessors[0]: reaches to byte 52 of its view, which has 48"},
        {"accessor offset that wraps",
         with(kPositions, replaced(kPositions, "5126", "5126, \"byteOffset\": 9007199254740992")), 0,
         "reaches to byte"},
        {"unknown component", with("5123", "5124"), 0, "are not the unsigned integers"},
        {"unknown component of positions", with(kPositions, replaced(kPositions, "5126", "1")), 0,
         "accessors[0].componentType: is no known type"},
        {"positions of unsigned integers", with(kPositions, replaced(kPositions, "5126", "5125")), 0,
         "accessors[0].componentType: is that of indices alone"},
        {"accessor without a view", with("\"bufferView\": 0, ", ""), 0, "all 2 have no area"},
        {"accessor of too many zeros",
         replaced(with("\"bufferView\": 0, ", ""), "\"count\": 4", "\"count\": 4000000000"), 0,
         "accessors[0].count: is larger than all that the file holds"},
        {"accessor of many zeros, three numbers each",
         replaced(with("\"bufferView\": 0, ", ""), "\"count\": 4", "\"count\": 1400000"), 0,
         "accessors[0].count: is larger than all that the file holds"},
        {"accessors of many zeros together",
         replaced(replaced(replaced(with("\"bufferView\": 0, ", ""), "\"bufferView\": 1, ", ""), "\"count\": 4",
                           "\"count\": 1000000"),
                  "\"count\": 4", "\"count\": 1000000"),
         0, "accessors[1].count: is larger than all that the file holds"},
        {"view out of range", with("\"bufferView\": 0", "\"bufferView\": 3"), 0, "but there are 3 bufferViews"},
        {"view too long", with("\"byteLength\": 12", "\"byteLength\": 13"), 0,
         "bufferViews[2]: reaches to byte 93 of 92"},
        {"view that wraps", with("\"byteOffset\": 80", "\"byteOffset\": 9007199254740992"), 0,
         "bufferViews[2]: reaches"},
        {"view without a length", with(", \"byteLength\": 48", ""), 0, "bufferViews[0].byteLength: is not a number"},
        {"stride 0", with("\"byteLength\": 48", "\"byteLength\": 48, \"byteStride\": 0"), 0,
         "byteStride is no multiple of 4"},
        {"stride too large", with("\"byteLength\": 48", "\"byteLength\": 48, \"byteStride\": 256"), 0,
         "bufferViews[0]: byteStride is no multiple of 4, from the 12 bytes of an element to 252"},
        {"stride below the size of an element", with("\"byteLength\": 48", "\"byteLength\": 48, \"byteStride\": 8"), 0,
         "bufferViews[0]: byteStride is no multiple of 4, from the 12 bytes"},
        {"stride of 13", with("\"byteLength\": 48", "\"byteLength\": 48, \"byteStride\": 13"), 0,
         "bufferViews[0]: byteStride is no multiple of 4"},
        {"stride beyond the view", with("\"byteLength\": 48", "\"byteLength\": 48, \"byteStride\": 16"), 0,
         "accessors[0]: reaches to byte 60"},
        {"buffer out of range", with("{\"buffer\": 0", "{\"buffer\": 1"), 0, "but there are 1 buffers"},
        {"buffer shorter than stated", with("\"byteLength\": 92", "\"byteLength\": 93"), 0,
         "buffers[0]: states 93 bytes, but there are 92"},
        {"buffer without a uri", square_gltf(""), 0, "buffers[0]: has no uri, and the file has no binary part for it"},
        {"missing file", square_gltf("\"uri\": \"no_such.bin\", "), 0, "no_such.bin: there is no such file"},
        {"missing file of a picture and of positions",
         replaced(with_texture(R"("bufferView": 0, "mimeType": "image/png")"),
                  "\"uri\": \"data:", R"("uri": "no_such.bin", "was": ")"),
         0, "no_such.bin: there is no such file"},
        {"a folder as buffer", square_gltf("\"uri\": \".\", "), 0, "buffers[0].uri: "},
        {"data not in base64", square_gltf("\"uri\": \"data:,abc\", "), 0,
         "buffers[0].uri: its data are not in base64"},
        {"characters behind the end of base64", square_gltf("\"uri\": \"" + data_uri(square_bytes()) + "=A\", "), 0,
         "buffers[0].uri: has characters behind the end of its base64"},
        {"a name with a zero", square_gltf("\"uri\": \"no_such%00.bin\", "), 0,
         "no_such%00.bin: there is no such file"},
        {"damaged base64", with(";base64,AAAA", ";base64,A*AA"), 0, "is none of base64"},
        {"positions not finite", with_bytes(0, floats({nan})), 0, "POSITION: a vertex of face 0 is not finite"},
        {"no area", with_bytes(0, std::string(48, '\0')), 0, "all 2 have no area, or stand nowhere"},
        {"texture coordinates not finite", with_bytes(48, floats({nan})), 2, "1 times the texture coordinate"},
        {"sparse out of range",
         with("\"type\": \"VEC3\"", R"("type": "VEC3", "sparse": {"count": 1, "indices": {"bufferView": 2,
              "byteOffset": 4, "componentType": 5121}, "values": {"bufferView": 5}})"),
         0, "accessors[0].sparse.values.bufferView: is 5"},
        {"sparse places of float",
         with("\"type\": \"VEC3\"", R"("type": "VEC3", "sparse": {"count": 1, "indices": {"bufferView": 1,
              "componentType": 5126}, "values": {"bufferView": 0}})"),
         0, "accessors[0].sparse.indices.componentType: is no type of unsigned integers"},
        {"sparse places that fall",
         with("\"type\": \"VEC3\"", R"("type": "VEC3", "sparse": {"count": 4, "indices": {"bufferView": 2,
              "componentType": 5123}, "values": {"bufferView": 0}})"),
         0, "accessors[0].sparse.indices: element 3 is not above the one before"},
        {"sparse element beyond the accessor",
         replaced(with_bytes(80, little(9, 2)), "\"type\": \"VEC3\"", R"("type": "VEC3", "sparse": {"count": 1,
              "indices": {"bufferView": 2, "componentType": 5123}, "values": {"bufferView": 0}})"),
         0, "accessors[0].sparse.indices: element 0 is beyond the 4 of the accessor"},
    };
    CHECK(verdicts.size() >= 40);
    check_verdicts(verdicts, ".gltf");
}

TEST_CASE("glTF: every broken or odd binary file has its verdict", "[io][gltf]") {
    const std::string whole = glb(square_gltf(""), square_bytes());
    const std::string json = glb_chunk("JSON", square_gltf(""), ' ');
    const std::vector<ModelVerdict> verdicts = {
        {"whole", whole, 2, ""},
        {"mark alone", "glTF", 0, "breaks off within its header"},
        {"version 1", replaced(whole, little(2, 4), little(1, 4)), 0,
         "is a binary glTF of version 1; version 2 is read"},
        {"breaks off", whole.substr(0, whole.size() - 4), 0, "breaks off: it states"},
        {"no chunk", "glTF" + little(2, 4) + little(12, 4), 0, "holds no JSON"},
        {"half a chunk's header", "glTF" + little(2, 4) + little(16, 4) + little(0, 4), 0, "breaks off before a chunk"},
        {"chunk too long", "glTF" + little(2, 4) + little(20, 4) + little(1, 4) + "JSON", 0, "a chunk states 1 bytes"},
        {"chunk of 4 GB", "glTF" + little(2, 4) + little(20, 4) + little(0xffffffff, 4) + "JSON", 0, "a chunk states"},
        {"binary chunk first", "glTF" + little(2, 4) + little(20, 4) + little(0, 4) + std::string("BIN\0", 4), 0,
         "its first chunk is not JSON"},
        {"no binary chunk", "glTF" + little(2, 4) + little(12 + json.size(), 4) + json, 0,
         "buffers[0]: has no uri, and the file has no binary part for it"},
        {"binary chunk too short", glb(square_gltf(""), square_bytes().substr(4)), 0,
         "buffers[0]: states 92 bytes, but there are 88"},
        {"JSON damaged", glb("{", ""), 0, "is no JSON"},
        {"unknown chunk", whole + glb_chunk("WHAT", "ever", ' '), 2, ""},
    };
    check_verdicts(verdicts, ".glb");
}

TEST_CASE("glTF: a file that breaks off, or of which a byte is changed, is refused or sound", "[io][gltf]") {
    check_damage({kSquare, glb(square_gltf(""), square_bytes())}, 12, 20);
}

}  // namespace limn::gltf_broken_test
