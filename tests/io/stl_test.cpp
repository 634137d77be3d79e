// STL, ASCII and binary.
#include <limits>

#include "broken_models.h"
#include "limn/scene/material/lambertian.h"
#include "limn/scene/shape/mesh_edges.h"

namespace limn::stl_test {

using namespace test;

namespace {

const std::string kFacet =
    "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1 0\n endloop\nendfacet\n";
const std::string kAscii = "solid a\n" + kFacet + "endsolid a\n";

std::string triangle(std::initializer_list<float> corners) {
    return floats({0, 0, 0}) + floats(corners) + std::string(2, '\0');
}

const std::string kTriangle = triangle({0, 0, 0, 1, 0, 0, 0, 1, 0});

std::string binary(std::uint32_t count, const std::string& triangles, const std::string& header = "made by a test") {
    return header + std::string(80 - header.size(), ' ') + little(count, 4) + triangles;
}

Model load(const std::string& bytes, const ModelOptions& options = {}) {
    const Folder folder;
    return load_model(folder.write("a.model", bytes), options);
}

// A tetrahedron, outside counter-clockwise.
std::string tetrahedron() {
    return binary(4, triangle({0, 0, 0, 0, 1, 0, 1, 0, 0}) + triangle({0, 0, 0, 1, 0, 0, 0, 0, 1}) +
                         triangle({0, 0, 0, 0, 0, 1, 0, 1, 0}) + triangle({1, 0, 0, 0, 1, 0, 0, 0, 1}));
}

}  // namespace

TEST_CASE("STL: text and bytes give the same mesh, whatever the name", "[io][stl]") {
    for (const std::string& bytes : {kAscii, binary(1, kTriangle)}) {
        const Model model = load(bytes);
        REQUIRE(model.meshes.size() == 1);
        const MeshData& data = model.meshes[0]->data();
        CHECK(data.vertices == std::vector<Float3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
        CHECK(data.triangles == std::vector<Index3>{{0, 1, 2}});
        CHECK(data.normals.empty());
        CHECK(model.instances.size() == 1);
        CHECK(model.faces == 1);
        CHECK(model.vertices == 3);
        CHECK(model.warnings.empty());
        CHECK(model.files.size() == 1);
    }
}

TEST_CASE("STL: corners at one position are one vertex, and the surface closes", "[io][stl]") {
    const Model model = load(tetrahedron());
    CHECK(model.vertices == 4);
    CHECK(model.faces == 4);
    CHECK(count_edges(*model.meshes[0]).is_closed());
    CHECK(load(binary(2, kTriangle + triangle({-0.0f, 0, 0, 1, 0, 0, 0, 0, 1}))).vertices == 4);
}

TEST_CASE("STL: numbers survive bit for bit", "[io][stl]") {
    const float least = std::numeric_limits<float>::denorm_min(), largest = std::numeric_limits<float>::max();
    const Model model = load(binary(1, triangle({least, 0, 0, largest, 0, 0, 0, 0.1f, 0})));
    CHECK(model.meshes[0]->data().vertices == std::vector<Float3>{{least, 0, 0}, {largest, 0, 0}, {0, 0.1f, 0}});
}

TEST_CASE("STL: a crease angle smooths what it is above", "[io][stl]") {
    CHECK(load(tetrahedron(), {.crease = 90}).meshes[0]->data().vertices.size() ==
          12);  // sides turn by 90 or 125 degrees
    CHECK(load(tetrahedron(), {.crease = 130}).meshes[0]->data().vertices.size() == 4);
    CHECK(load(tetrahedron()).meshes[0]->data().normals.empty());
    CHECK_THROWS_AS(load(tetrahedron(), {.crease = 200}), ArgumentError);
}

TEST_CASE("STL: a solid is grey, or what the caller says", "[io][stl]") {
    const auto material = std::make_shared<Lambertian>(Color{1, 0, 0});
    CHECK(load(kAscii, {.default_material = material}).meshes[0]->materials()[0] == material);
    CHECK(load(kAscii).materials.empty());
}

TEST_CASE("STL: every broken or odd file has its verdict", "[io][stl]") {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    const std::string flat = triangle({0, 0, 0, 1, 0, 0, 2, 0, 0});
    const std::vector<ModelVerdict> verdicts = {
        {"binary, empty", "", 0, "shorter than the header"},
        {"binary, header alone", std::string(80, ' '), 0, "shorter than the header"},
        {"binary, no triangle", binary(0, ""), 0, "has no usable face: there is no triangle"},
        {"binary, breaks off", binary(2, kTriangle), 0, "breaks off: it states 2 triangles, and holds 1"},
        {"binary, breaks off within a triangle", binary(1, kTriangle.substr(1)), 0, "states 1 triangles, and holds 0"},
        {"binary, 2^32 - 1 triangles", binary(0xffffffff, kTriangle), 0, "it states 4294967295 triangles"},
        {"binary, size wraps in 32 bits", binary(85899346, kTriangle), 0, "it states 85899346 triangles"},
        {"binary, more than it states", binary(1, kTriangle + "more"), 1, "4 bytes behind the last triangle"},
        {"binary, a whole triangle more", binary(1, kTriangle + kTriangle), 1, "50 bytes behind the last triangle"},
        {"binary, NaN", binary(2, kTriangle + triangle({0, 0, 0, 1, nan, 0, 0, 1, 0})), 0,
         "triangle 1 has a corner that is not finite"},
        {"binary, infinity", binary(1, triangle({0, 0, 0, 1, 0, 0, 0, -inf, 0})), 0, "triangle 0 has a corner"},
        {"binary, NaN as normal", binary(1, floats({nan, nan, nan}) + kTriangle.substr(12)), 1, ""},
        {"binary, without area", binary(1, flat), 0, "all 1 have fewer than three corners or no area"},
        {"binary, one without area", binary(2, flat + kTriangle), 1, ""},
        {"binary, begins with solid", binary(1, kTriangle, "solid facet"), 1, ""},
        {"binary, begins with solid and breaks off", binary(2, kTriangle, "solid" + std::string(70, '\0')), 0,
         "breaks off"},
        {"binary, begins as a PNM", binary(1, kTriangle, "P3 made by a test"), 1, ""},
        {"binary, begins as a BMP", binary(1, kTriangle, "BMs of a roof"), 1, ""},
        {"binary, begins as a TIFF", binary(1, kTriangle, std::string("II*\0", 4)), 1, ""},
        {"binary, begins as an HDR", binary(1, kTriangle, "#?RADIANCE"), 1, ""},
        {"binary, begins as a PLY", binary(1, kTriangle, "ply\n"), 1, ""},
        {"binary, attributes", binary(1, kTriangle.substr(0, 48) + "\xff\x7f"), 1, ""},
        {"ASCII, breaks off within a number", kAscii.substr(0, kAscii.find("1 0\n endloop") + 1), 0,
         "line 6: vertex needs 3 numbers"},
        {"ASCII, breaks off within a facet", kAscii.substr(0, kAscii.find("endfacet")), 0,
         "line 7: the file breaks off within a facet"},
        {"ASCII, with a byte order mark", "\xef\xbb\xbf" + kAscii, 1, ""},
        {"ASCII, without endsolid", "solid\n" + kFacet, 1, "there is no endsolid"},
        {"ASCII, without facets", "solid a\nendsolid a\n", 0, "has no usable face: there is no triangle"},
        {"ASCII, two corners", replaced(kAscii, "  vertex 0 1 0\n", ""), 0, "line 6: a facet has 2 corners, not three"},
        {"ASCII, four corners", replaced(kAscii, " endloop", "vertex 1 1 0\nendloop"), 0, "a facet has 4 corners"},
        {"ASCII, no loop", "solid\nfacet normal 0 0 1\nendfacet\nendsolid\n", 0, "line 3: a facet has no corners"},
        {"ASCII, two loops", replaced(kAscii, "endfacet", "outer loop\nendloop\nendfacet"), 0,
         "line 8: a facet has a second loop"},
        {"ASCII, vertex outside", replaced(kAscii, " outer loop\n", ""), 0, "line 3: vertex is not allowed here"},
        {"ASCII, a facet in a facet", replaced(kAscii, "endfacet\n", "facet normal 0 0 1\n"), 0,
         "line 8: facet is not allowed here"},
        {"ASCII, a solid in a solid", replaced(kAscii, "facet", "solid b\nfacet"), 0, "line 2: solid is not allowed"},
        {"ASCII, a word for a number", replaced(kAscii, "1 0 0", "1 O 0"), 0, "line 5: 'O' is not a number"},
        {"ASCII, NaN", replaced(kAscii, "1 0 0", "1 nan 0"), 0, "line 5: 'nan' is not a number"},
        {"ASCII, too large", replaced(kAscii, "1 0 0", "1e39 0 0"), 0, "line 5: '1e39' is not a number"},
        {"ASCII, NaN as normal", replaced(kAscii, "normal 0 0 1", "normal nan nan nan"), 1, ""},
        {"ASCII, two solids", kAscii + kAscii, 2, ""},
        {"ASCII, upper case",
         "SOLID A\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 0 1 0\n"
         "ENDLOOP\nENDFACET\nENDSOLID\n",
         1, ""},
        {"ASCII, CR LF and a folder as name",
         replaced(replaced(kAscii, "solid a\n", "solid C:\\a\\\r\n"), "\nfacet", "\nfacet"), 1, ""},
        {"ASCII, colours", replaced(kAscii, "facet", "color 1 0 0\nfacet"), 1,
         "1 line was passed over; the first is line 2"},
        {"ASCII, without area", replaced(kAscii, "0 1 0", "2 0 0"), 0, "all 1 have fewer than three corners"},
    };
    CHECK(verdicts.size() >= 30);
    check_verdicts(verdicts, ".stl");
}

TEST_CASE("STL: a file that breaks off, or of which a byte is changed, is refused or sound", "[io][stl]") {
    check_damage({kAscii + kAscii, tetrahedron()}, 0, 100);
}

}  // namespace limn::stl_test
