// Files that are no model: each is refused with the file's name and the line at fault, or loads with every index in
// range and every coordinate finite.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "catch.h"
#include "io/obj_mesh.h"
#include "io/obj_parse.h"
#include "limn/core/error.h"
#include "limn/io/obj.h"
#include "support/folder.h"

using namespace limn;
using namespace limn::test;

namespace {

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

struct Broken {
    std::string text;
    int line;  // 0: the whole file is at fault
    std::string reason;
};

// What load_obj would say, without a file on the disk; whether it gives a mesh.
bool is_sound(const std::string& text) {
    try {
        const ObjFile file = parse_obj(text, "broken.obj");
        const ObjMesh mesh = build_mesh(file);
        const MeshData& d = mesh.data;
        for (const Index3& t : d.triangles) REQUIRE(std::max({t.a, t.b, t.c}) < d.vertices.size());
        for (const Float3& v : d.vertices) REQUIRE((std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z)));
        if (d.triangles.empty()) return false;
        CHECK_NOTHROW(Mesh(d, std::vector<std::shared_ptr<const Material>>(1 + file.materials.size())));
        CHECK(mesh.dropped_faces < file.face_count);
        return true;
    } catch (const FileError&) {
        return false;
    }
}

}  // namespace

TEST_CASE("Broken OBJ: refused with the file, the line and the reason", "[io][obj]") {
    const Broken cases[] = {
        {"", 0, "no usable face"},
        {"\n\n# nothing\n", 0, "no usable face"},
        {std::string(300, '\0'), 0, "no usable face"},
        {kTriangle, 0, "no line with f"},
        {kTriangle + "f 1 2\n", 0, "no usable face"},
        {kTriangle + "f\n", 0, "no usable face"},
        {kTriangle + "f 1 1 1\nf 1 2 2\n", 0, "all 2 have"},
        {"v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n", 0, "no usable face"},
        {"f 1 2 3\n", 1, "vertex 1, but the file has 0"},
        {kTriangle + "f 1 2 4\n", 4, "vertex 4, but the file has 3"},
        {kTriangle + "f 1 2 3\n\nf 2 3 9 1\n", 6, "vertex 9, but the file has 3"},
        {kTriangle + "f 1 2\nf 1 9\n", 5, "vertex 9"},
        {kTriangle + "f 1 2 2147483647\n", 4, "2147483647"},
        {kTriangle + "f 1 2 2147483648\n", 4, "2147483648"},
        {kTriangle + "f 1 2 4294967297\n", 4, "4294967297"},
        {kTriangle + "f 1 2 99999999999999999999\n", 4, "99999999999999999999"},
        {kTriangle + "f 1 2 -99999999999999999999\n", 4, "-99999999999999999999"},
        {kTriangle + "f 1 2 -4\n", 4, "vertex -4, but only 3 are defined so far"},
        {"v 0 0 0\nf -1 -2 -3\n" + kTriangle, 2, "vertex -2"},
        {kTriangle + "f 0 1 2\n", 4, "counted from 1"},
        {kTriangle + "f 1 2 -0\n", 4, "counted from 1"},
        {kTriangle + "f 1 2 three\n", 4, "vertex three, which is not a number"},
        {kTriangle + "f 1 2 3.5\n", 4, "3.5"},
        {kTriangle + "f 1 2 3x\n", 4, "3x"},
        {kTriangle + "f 1 2 /3\n", 4, "not a corner"},
        {kTriangle + "f 1/1/1/1 2 3\n", 4, "not a corner"},
        {kTriangle + "f 1 2 //\n", 4, "not a corner"},
        {kTriangle + "f 1/1 2/1 3/1\n", 4, "texture coordinate 1, but the file has 0"},
        {kTriangle + "vt 0 0\nf 1/1 2/2 3/1\n", 5, "texture coordinate 2"},
        {kTriangle + "vn 0 0 1\nf 1//1 2//1 3//2\n", 5, "normal 2"},
        {kTriangle + "f 1/-1 2 3\n", 4, "texture coordinate -1"},
        {kTriangle + "f 1//-1 2 3\n", 4, "normal -1"},
        {kTriangle + "f 1//0 2 3\n", 4, "counted from 1"},
        {"v 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", 1, "needs 3 numbers"},
        {"v\n" + kTriangle + "f 1 2 3\n", 1, "needs 3 numbers"},
        {kTriangle + "v a b c\nf 1 2 3\n", 4, "'a' is not a number"},
        {kTriangle + "v 1 2 nan\nf 1 2 3\n", 4, "'nan'"},
        {kTriangle + "v inf 2 3\nf 1 2 3\n", 4, "'inf'"},
        {kTriangle + "v 1 2 1e40\nf 1 2 3\n", 4, "'1e40'"},
        {kTriangle + "v 1 -1e400 1\nf 1 2 3\n", 4, "'-1e400'"},
        {kTriangle + "v 1,5 2 3\nf 1 2 3\n", 4, "'1,5'"},
        {kTriangle + "v 1 2 3 x\nf 1 2 3\n", 4, "'x'"},
        {kTriangle + "vn 0 1\nf 1 2 3\n", 4, "vn needs 3 numbers"},
        {kTriangle + "vn 0 1 nan\nf 1 2 3\n", 4, "'nan'"},
        {kTriangle + "vt\nf 1 2 3\n", 4, "vt needs 1 numbers"},
        {kTriangle + "vt 0 1e39\nf 1 2 3\n", 4, "'1e39'"},
        {"\xef\xbb\xbf" + kTriangle + "\r\nf 1 2 \\\r\n 3 \\\r\n 7\r\n", 5, "vertex 7"},
        {kTriangle + "f 1 2 \\\n3\nv x\n", 6, "needs 3"},
        {kTriangle + "v \xff\xfe 1 1\nf 1 2 3\n", 4, "is not a number"},
    };
    const Folder folder;
    for (const Broken& broken : cases) {
        const std::string path = folder.write("a.obj", broken.text);
        std::string message = "accepted";
        try {
            load_obj(path);
        } catch (const FileError& error) {
            message = error.what();
            CHECK(error.path() == path);
        }
        CAPTURE(broken.text, message);
        CHECK(message.starts_with(path + ": " + (broken.line ? "line " + std::to_string(broken.line) + ": " : "")));
        CHECK(message.find(broken.reason) != std::string::npos);
    }
}

TEST_CASE("Broken OBJ: a missing file and a folder are refused with their name", "[io][obj]") {
    const Folder folder;
    CHECK_THROWS_WITH(load_obj(folder.path("no_such.obj")), folder.path("no_such.obj") + ": there is no such file");
    CHECK_THROWS_WITH(load_obj(folder.path()), folder.path() + ": is a folder, not a file");
}

TEST_CASE("Broken OBJ: wherever a file breaks off, it is refused or sound", "[io][obj]") {
    std::string whole = "mtllib none.mtl\nusemtl grey\n";
    for (int i = 0; i < 40; ++i)
        whole += "v " + std::to_string(i % 7) + ".25 " + std::to_string(i % 5) + " 1e-1\nvt 0.5 .5\n";
    for (int i = 1; i < 38; ++i)
        whole +=
            "f " + std::to_string(i) + "/1 " + std::to_string(i + 1) + "/-1 " + std::to_string(i + 3) + "/2 -1/1\n";
    std::size_t loaded = 0;
    for (std::size_t size = 0; size < whole.size(); ++size) loaded += is_sound(whole.substr(0, size));
    CHECK(loaded > 300);
    CHECK(loaded < whole.size());
}

TEST_CASE("Broken OBJ: whatever is changed in a file, it is refused or sound", "[io][obj]") {
    const std::string whole =
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\ng a\nusemtl x\nf 1/1/1 2//1 3/1 4\nf -1 -2 -3\n";
    const std::string pieces = "0123456789-+./ \n\\#efvtn\t\r\"x\xff" + std::string(1, '\0');
    std::mt19937 generator(9);
    std::size_t loaded = 0;
    for (int i = 0; i < 20'000; ++i) {
        std::string text = whole;
        for (std::uint_fast32_t changes = 1 + generator() % 3; changes > 0; --changes) {
            const std::size_t place = generator() % text.size();
            if (generator() % 2)
                text[place] = pieces[generator() % pieces.size()];
            else
                text.insert(place, 1, pieces[generator() % pieces.size()]);
        }
        CAPTURE(text);
        loaded += is_sound(text);
    }
    CHECK(loaded > 2000);
    CHECK(loaded < 18'000);
}
