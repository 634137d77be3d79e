// PLY: ASCII, binary of both ends.
#include <algorithm>
#include <cmath>
#include <limits>

#include "broken_models.h"
#include "limn/math/surface.h"
#include "limn/scene/material/lambertian.h"

namespace limn::ply_test {

using namespace test;

namespace {

const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
const std::string kIndices = "property list uchar int vertex_indices\n";

std::string header(const std::string& elements, const std::string& format = "ascii") {
    return "ply\nformat " + format + " 1.0\ncomment by a test\n" + elements + "end_header\n";
}

std::string element(const std::string& name, std::size_t count, const std::string& properties) {
    return "element " + name + " " + std::to_string(count) + "\n" + properties;
}

const std::string kElements = element("vertex", 4, kXyz) + element("face", 1, kIndices);
const std::string kSquare = header(kElements) + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

// Numbers of a binary file, turned where its format is big endian.
std::string in_order(std::string bytes, bool is_big) {
    if (is_big) std::reverse(bytes.begin(), bytes.end());
    return bytes;
}

std::string binary_square(bool is_big, const std::string& index_type = "int", std::size_t index_size = 4) {
    std::string bytes = header(
        element("vertex", 4, kXyz) + element("face", 1, "property list uchar " + index_type + " vertex_indices\n"),
        is_big ? "binary_big_endian" : "binary_little_endian");
    for (const float v : std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) bytes += in_order(floats({v}), is_big);
    bytes += '\4';
    for (const std::uint64_t index : {0U, 1U, 2U, 3U}) bytes += in_order(little(index, index_size), is_big);
    return bytes;
}

Model load(const std::string& bytes, const ModelOptions& options = {}) {
    const Folder folder;
    return load_model(folder.write("a.model", bytes), options);
}

MeshData data_of(const Model& model) {
    REQUIRE(model.meshes.size() == 1);
    return model.meshes[0]->data();
}

}  // namespace

TEST_CASE("PLY: text and bytes of both ends give the same mesh, cut as an OBJ's polygons are", "[io][ply]") {
    std::string cr = kSquare;
    std::replace(cr.begin(), cr.end(), '\n', '\r');
    const std::string one_line = header(kElements) + "0 0 0 1 0 0 1 1 0 0 1 0 4 0 1 2 3";
    for (const std::string& bytes :
         {kSquare, cr, one_line, binary_square(false), binary_square(true), binary_square(true, "ushort", 2),
          binary_square(false, "uint8", 1), replaced(binary_square(false), "float x", "float32 x")}) {
        const Model model = load(bytes);
        const MeshData data = data_of(model);
        CHECK(data.vertices == std::vector<Float3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
        CHECK(data.triangles == std::vector<Index3>{{0, 1, 2}, {0, 2, 3}});
        CHECK(data.faces == std::vector<std::uint32_t>{0, 0});
        CHECK(model.faces == 1);
        CHECK(model.vertices == 4);
        CHECK(model.warnings.empty());
        CHECK(model.materials.empty());
    }
}

TEST_CASE("PLY: lines that end in CR alone may stand before data that begins with LF", "[io][ply]") {
    std::string bytes = header(element("vertex", 3, kXyz) + element("face", 1, kIndices), "binary_little_endian");
    std::replace(bytes.begin(), bytes.end(), '\n', '\r');
    const float ten = std::bit_cast<float>(0x4120000au);  // its first byte is LF
    bytes += floats({ten, 0, 0, 1, 0, 0, 0, 1, 0}) + '\3' + little(0, 4) + little(1, 4) + little(2, 4);
    CHECK(data_of(load(bytes)).vertices[0].x == ten);
}

TEST_CASE("PLY: elements and properties without a use are passed over", "[io][ply]") {
    const std::string text =
        header(element("camera", 2, "property float a\nproperty list int float b\n") +
               element("vertex", 3,
                       "property list uchar uchar tags\nproperty float y\nproperty float x\n"
                       "property double z\nproperty float quality\n") +
               element("nothing", 99, "") +
               element("face", 1, "property uchar flags\n" + kIndices + "property list uchar float texcoord\n") +
               element("edge", 1, "property int vertex1\n")) +
        "1 0\n2 2 3 4\n" + "2 7 8 0 0 0 1\n0 0 1 0 nan\n0 1 0 0 inf\n" + "5 3 0 1 2 2 0.5 0.5\n7\n";
    const Model model = load(text);
    CHECK(data_of(model).vertices == std::vector<Float3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    CHECK(data_of(model).triangles == std::vector<Index3>{{0, 1, 2}});
    CHECK(model.warnings.empty());
}

TEST_CASE("PLY: triangle strips turn every other triangle, and -1 begins anew", "[io][ply]") {
    const std::string text = header(element("vertex", 5, kXyz) + element("tristrips", 1, kIndices)) +
                             "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n" + "9 0 1 2 3 -1 2 3 4 -1\n";
    const Model model = load(text);
    CHECK(data_of(model).triangles == std::vector<Index3>{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}});
    CHECK(model.faces == 3);
}

TEST_CASE("PLY: normals and texture coordinates are those of the vertices", "[io][ply]") {
    const std::string text = header(element("vertex", 3,
                                            kXyz + "property float nx\nproperty float ny\nproperty float nz\n"
                                                   "property float s\nproperty float t\n") +
                                    element("face", 1, kIndices)) +
                             "0 0 0 0 0 2 0.5 0\n1 0 0 0 0 0 1 0\n0 1 0 nan 0 1 1 nan\n3 0 1 2\n";
    const Model model = load(text, {.crease = 30});
    const MeshData data = data_of(model);
    CHECK(data.normals == std::vector<Float3>{{0, 0, 2}, {0, 0, 1}, {0, 0, 1}});
    CHECK(data.uvs == std::vector<Float2>{{0.5f, 0}, {1, 0}, {0, 0}});
    REQUIRE(model.warnings.size() == 2);
    CHECK(model.warnings[0].starts_with("2 times the normal"));
    CHECK(model.warnings[1].starts_with("1 times the texture coordinate"));
}

TEST_CASE("PLY: colours of the corners are interpolated by their weights", "[io][ply]") {
    const std::string text =
        header(element("vertex", 4, kXyz + "property uchar red\nproperty uchar green\nproperty uchar blue\n") +
               element("face", 2, kIndices)) +
        "0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n1 1 0 128 128 128\n3 0 1 2\n3 1 3 2\n";
    Model model = load(text);
    CHECK(model.materials == std::vector<std::string>{"vertex colours"});
    const auto albedo_at = [&](double x, double y) {
        const Ray ray{.origin = {x, y, 1}, .direction = {0, 0, -1}};
        const auto hit = model.meshes[0]->hit(ray);
        REQUIRE(hit);
        Surface s;
        s.uv = *hit->uv;
        s.normal = s.shading_normal = hit->normal;
        const Vec3 up{0, 0, 1};
        return hit->material->value(s, up, up).value * kPi;
    };
    const auto check = [&](double x, double y, const Color& expected) {
        const Color c = albedo_at(x, y);
        CHECK(std::abs(c.r - expected.r) + std::abs(c.g - expected.g) + std::abs(c.b - expected.b) < 1e-5);
    };
    const double grey = srgb_decode(128 / 255.0);
    check(0.25, 0.25, {0.5, 0.25, 0.25});
    check(0.125, 0.5, {0.375, 0.125, 0.5});
    check(0.75, 0.75, {0.5 * grey, 0.25 + 0.5 * grey, 0.25 + 0.5 * grey});
    const auto white = std::make_shared<Lambertian>(Color{1, 1, 1});
    model.replace_material("vertex colours", white);
    CHECK(model.meshes[0]->hit({.origin = {0.2, 0.2, 1}, .direction = {0, 0, -1}})->material == white.get());
}

TEST_CASE("PLY: integer colours are of 255 whatever their type, but of 65535 as ushort, and floats of 1", "[io][ply]") {
    const auto red_of = [](const std::string& type, const std::string& stored) {
        const std::string colors = "property T red\nproperty T green\nproperty T blue\n";
        const std::string typed = replaced(replaced(replaced(colors, "T", type), "T", type), "T", type);
        const std::string line = " " + stored + " 0 0\n";
        const Model model = load(header(element("vertex", 3, kXyz + typed) + element("face", 1, kIndices)) + "0 0 0" +
                                 line + "1 0 0" + line + "0 1 0" + line + "3 0 1 2\n");
        const auto hit = model.meshes[0]->hit({.origin = {0.2, 0.2, 1}, .direction = {0, 0, -1}});
        REQUIRE(hit);
        Surface s;
        s.uv = *hit->uv;
        s.normal = s.shading_normal = hit->normal;
        return hit->material->value(s, {0, 0, 1}, {0, 0, 1}).value.r * kPi;
    };
    for (const char* type : {"char", "uchar", "short", "int", "uint", "int8", "int16", "int32", "uint32"}) {
        CAPTURE(type);
        CHECK(red_of(type, "100") == Approx(srgb_decode(100 / 255.0)).epsilon(1e-5));
    }
    for (const char* type : {"short", "int", "uint"}) CHECK(red_of(type, "300") == Approx(1).epsilon(1e-5));
    CHECK(red_of("int", "-1") == 0);
    CHECK(red_of("ushort", "25700") == Approx(srgb_decode(100 / 255.0)).epsilon(1e-5));
    CHECK(red_of("float", "0.25") == Approx(0.25).epsilon(1e-5));
}

TEST_CASE("PLY: every broken or odd file has its verdict", "[io][ply]") {
    const auto with = [](const std::string& what, const std::string& by) { return replaced(kSquare, what, by); };
    const std::string little_square = binary_square(false), big = std::string("4294967295");
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<ModelVerdict> verdicts = {
        {"header breaks off", "ply\nformat ascii 1.0\n", 0, "line 2: the header breaks off before end_header"},
        {"first line alone", "ply\n", 0, "line 1: the header breaks off"},
        {"no format", with("format ascii 1.0\n", ""), 0, "the header does not say the format"},
        {"format without a version", with("ascii 1.0", "ascii"), 0, "line 2: format needs a name and a version"},
        {"unknown format", with("ascii", "binary"), 0, "line 2: 'binary' is no format of a PLY"},
        {"unknown version", with("1.0", "2.0"), 0, "line 2: version 2.0 cannot be read"},
        {"element without a number", with("face 1", "face"), 0, "line 8: element needs a name and a number"},
        {"an element twice", with("element face", "element vertex 9\nelement face"), 0,
         "line 8: a second element 'vertex'"},
        {"negative number of elements", with("face 1", "face -1"), 0, "line 8: '-1' is not a number of elements"},
        {"too many elements", with("face 1", "face 999999"), 0, "line 8: the file is too short for 999999 elements"},
        {"twenty digits of elements", with("face 1", "face 99999999999999999999"), 0, "is not a number of elements"},
        {"property before elements", with("element vertex 4\n", ""), 0, "line 4: a property before any element"},
        {"property without a name", with("float x", "float"), 0, "line 5: property needs a type and a name"},
        {"list without a name", with(" vertex_indices", ""), 0, "line 9: property needs a type and a name"},
        {"unknown type", with("float x", "real x"), 0, "line 5: 'real' is no type of a PLY"},
        {"length of a list as float", with("list uchar", "list float"), 0, "the length of a list must be an integer"},
        {"indices as float", with("uchar int", "uchar float"), 0, "'face' has no list of integers vertex_indices"},
        {"indices without a list", with("list uchar int vertex_indices", "int vertex_indices"), 0, "has no list of"},
        {"faces without indices", with("vertex_indices", "corners"), 0, "'face' has no list of integers"},
        {"vertices without z", with("property float z", "property float w"), 0, "its vertices have no x, y and z"},
        {"no vertices", header(element("face", 1, kIndices)) + "3 0 1 2\n", 0, "its faces come before its vertices"},
        {"no faces", header(element("vertex", 1, kXyz)) + "0 0 0\n", 0, "has no usable face: it holds points alone"},
        {"no elements", header(""), 0, "has no usable face"},
        {"unknown line", with("comment", "Created"), 2, "1 line was passed over; the first is line 3"},
        {"index too large", with("4 0 1 2 3", "4 0 1 2 4"), 0,
         "line 15: face 0 refers to vertex 4, but the file has 4"},
        {"negative index", with("4 0 1 2 3", "4 0 1 2 -1"), 0, "line 15: face 0 refers to vertex -1"},
        {"index with a point", with("4 0 1 2 3", "4 0 1 2 3.0"), 0, "line 15: '3.0' is not an integer"},
        {"text breaks off", kSquare.substr(0, kSquare.size() - 3), 0,
         "line 15: a list of 4 numbers does not fit into the file"},
        {"text without faces", kSquare.substr(0, kSquare.find("4 0 1")), 0, "the file breaks off"},
        {"long list", with("4 0 1 2 3", "200 0 1 2 3"), 0, "line 15: a list of 200 numbers does not fit"},
        {"negative list", replaced(with("4 0 1 2 3", "-4 0 1 2 3"), "uchar", "char"), 0, "a list of -4 numbers"},
        {"word for a number", with("1 0 0", "1 O 0"), 0, "line 12: 'O' is not a number"},
        {"NaN", with("1 0 0", "nan 0 0"), 0, "line 12: vertex 1 is not finite"},
        {"too large for float32", with("1 0 0", "1e39 0 0"), 0, "line 12: vertex 1 is not finite"},
        {"two corners", with("4 0 1 2 3", "2 0 1"), 0, "all 1 have fewer than three corners or no area"},
        {"no area", with("4 0 1 2 3", "3 0 1 1"), 0, "all 1 have fewer than three corners or no area"},
        {"words behind the last face", kSquare + "and more\n", 2, "words behind the last element"},
        {"blanks behind the last face", kSquare + " \n\n", 2, ""},
        {"bytes behind the last face", little_square + "abc", 2, "3 bytes behind the last element"},
        {"a coordinate that is a list",
         replaced(replaced(kSquare, "property float z", "property list uchar float z"), "0 0 0", "0 0 1 0"), 0,
         "its vertices have no x, y and z"},
        {"a blank behind the first word", replaced(kSquare, "ply\n", "ply \n"), 2, ""},
        {"bytes break off", little_square.substr(0, little_square.size() - 1), 0, "a list of 4 numbers does not fit"},
        {"bytes break off at a vertex", little_square.substr(0, little_square.find("end_header\n") + 11 + 46), 0,
         ": the file breaks off"},
        {"bytes of another end", replaced(little_square, "little", "big"), 0, "refers to vertex"},
        {"bytes with a large list", replaced(little_square, std::string("\4") + little(0, 4), "\xff" + little(0, 4)), 0,
         "a list of 255 numbers does not fit into the file"},
        {"bytes with a huge list",
         replaced(replaced(little_square, "list uchar", "list uint"), std::string("\4") + little(0, 4),
                  little(0xffffffff, 4)),
         0, "a list of " + big + " numbers"},
        {"bytes with an index too large", replaced(little_square, little(3, 4), little(0x7fffffff, 4)), 0,
         "face 0 refers to vertex 2147483647"},
        {"bytes with NaN", replaced(little_square, floats({1, 0, 0}), floats({nan, 0, 0})), 0,
         "vertex 1 is not finite"},
        {"no data at all", header(kElements, "binary_little_endian"), 0, "byte "},
        {"text said to be bytes", with("ascii", "binary_little_endian"), 0, "byte "},
    };
    CHECK(verdicts.size() >= 30);
    check_verdicts(verdicts, ".ply");
}

TEST_CASE("PLY: a file that breaks off, or of which a byte is changed, is refused or sound", "[io][ply]") {
    check_damage({kSquare, binary_square(false), binary_square(true)}, 4, 100);
}

}  // namespace limn::ply_test
