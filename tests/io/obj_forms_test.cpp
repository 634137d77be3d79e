// The ways in which an OBJ file may state a mesh.
#include <cmath>

#include "catch.h"
#include "formats.h"
#include "geometry/mesh_triangle.h"
#include "io/text_lines.h"
#include "limn/io/obj.h"
#include "limn/math/error.h"
#include "support/folder.h"

namespace limn::obj_forms_test {

using namespace test;

namespace {

Model load(const std::string& text) {
    const Folder folder;
    return load_obj(folder.write("a.obj", text));
}

MeshData data_of(const Model& model) {
    REQUIRE(model.meshes.size() == 1);
    return model.meshes[0]->data();
}

double total_area(const Model& model) {
    const MeshData d = data_of(model);
    double sum = 0;
    for (const Index3& t : d.triangles) {
        const Point3 a = to_point(d.vertices[t.a]);
        sum += length(cross(to_point(d.vertices[t.b]) - a, to_point(d.vertices[t.c]) - a)) / 2;
    }
    return sum;
}

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

}  // namespace

TEST_CASE("OBJ: a plain triangle keeps the file's vertices", "[io][obj]") {
    const Model model = load(kTriangle + "v 9 9 9\nf 1 2 3\n");
    const MeshData d = data_of(model);
    CHECK(d.vertices == std::vector<Float3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 9}});
    CHECK(d.triangles == std::vector<Index3>{{0, 1, 2}});
    CHECK(d.normals.empty());
    CHECK(d.uvs.empty());
    CHECK(model.vertices == 4);
    CHECK(model.faces == 1);
    CHECK(model.materials.empty());
    CHECK(model.dropped_faces == 0);
    CHECK(model.degenerate_triangles == 0);
    CHECK(model.warnings.empty());
    CHECK(model.bounds() == Box{Point3{0, 0, 0}, Point3{1, 1, 0}});
}

TEST_CASE("OBJ: byte order mark, CR LF, no final newline, continued lines and blanks change nothing", "[io][obj]") {
    const std::string text = GENERATE(
        as<std::string>{}, "\xef\xbb\xbfv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3",
        "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3", "v 0 \\\n0 0\nv 1 0 0\nv 0 1 0\nf 1 \\\r\n2 3",
        "\tv  0\t0 0 \nv 1 0 0 # right\nv 0 1 0\n# C:\\\n  f 1  2\t3 # all", "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n");
    const MeshData d = data_of(load(text));
    CHECK(d.vertices == std::vector<Float3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    CHECK(d.triangles == std::vector<Index3>{{0, 1, 2}});
}

TEST_CASE("OBJ: text that holds a picture's mark behind its beginning is text", "[io][obj]") {
    const Folder folder;
    for (const std::string comment : {"# a JXL texture", "# a jP  texture", "#   ftypavif", "#   ftypheic",
                                      "#   ftypmif1", "#       WEBP", "#? what"}) {
        CAPTURE(comment);
        folder.write("a.mtl", comment + "\nnewmtl m\n");
        const Model model =
            load_obj(folder.write("a.obj", comment + "\nmtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n"));
        CHECK(model.faces == 1);
        CHECK(model.warnings.empty());
    }
}

TEST_CASE("OBJ: v, v/vt, v//vn and v/vt/vn are all understood", "[io][obj]") {
    const std::string all = kTriangle + "vt 0.25 0.5\nvt 0.75 1\nvt 0\nvn 0 0 1\nvn 0 0.5 0\n";
    const MeshData uv = data_of(load(all + "f 1/1 2/2 3/3\n"));
    CHECK(uv.uvs == std::vector<Float2>{{0.25f, 0.5f}, {0.75f, 1}, {0, 0}});
    CHECK(uv.normals.empty());
    const MeshData normal = data_of(load(all + "f 1//1 2//1 3//2\n"));
    CHECK(normal.normals == std::vector<Float3>{{0, 0, 1}, {0, 0, 1}, {0, 0.5f, 0}});
    CHECK(normal.uvs.empty());
    const MeshData both = data_of(load(all + "f 1/3/2 2/2/1 3/1/1\n"));
    CHECK(both.uvs == std::vector<Float2>{{0, 0}, {0.75f, 1}, {0.25f, 0.5f}});
    CHECK(both.normals == std::vector<Float3>{{0, 0.5f, 0}, {0, 0, 1}, {0, 0, 1}});
    CHECK(data_of(load(all + "f 1/ 2// 3\n")).uvs.empty());
}

TEST_CASE("OBJ: negative indices count back from the line they stand in", "[io][obj]") {
    const Model model =
        load(kTriangle + "vt 0 0\nvt 1 1\nf -3/-2 -2/-1 -1/-1\nv 5 0 0\nv 6 0 0\nv 5 1 0\nvt 9 9\nf -3 -2 -1\n");
    const MeshData d = data_of(model);
    REQUIRE(d.triangles.size() == 2);
    const auto position = [&d](std::uint32_t i) { return d.vertices[i]; };
    CHECK(position(d.triangles[0].a) == Float3{0, 0, 0});
    CHECK(position(d.triangles[0].c) == Float3{0, 1, 0});
    CHECK(d.uvs[d.triangles[0].b] == Float2{1, 1});
    CHECK(position(d.triangles[1].a) == Float3{5, 0, 0});
    CHECK(position(d.triangles[1].b) == Float3{6, 0, 0});
}

TEST_CASE("OBJ: a vertex is split only where its normal or texture coordinate differs", "[io][obj]") {
    const Model model = load(kSquare + "vt 0 0\nvt 1 1\nf 1/1 2/1 3/1\nf 1/1 3/2 4/1\n");
    const MeshData d = data_of(model);
    CHECK(d.vertices.size() == 5);
    CHECK(d.triangles[0].a == d.triangles[1].a);
    CHECK(d.triangles[0].c != d.triangles[1].b);
    CHECK(d.vertices[d.triangles[0].c] == d.vertices[d.triangles[1].b]);
}

TEST_CASE("OBJ: a corner without a normal, or with one of length zero, gets its face's", "[io][obj]") {
    const Model model = load(kSquare + "v 0 0 1\nvn 1 0 0\nvn 0 0 0\nf 1//1 2//1 3//1\nf 1 3 4\nf 1//2 2//1 5\n");
    const MeshData d = data_of(model);
    const auto normal = [&d](std::size_t triangle, int corner) {
        const Index3 t = d.triangles[triangle];
        return d.normals[corner == 0 ? t.a : corner == 1 ? t.b : t.c];
    };
    for (int corner = 0; corner < 3; ++corner) {
        CHECK(normal(0, corner) == Float3{1, 0, 0});
        CHECK(normal(1, corner) == Float3{0, 0, 1});
    }
    CHECK(normal(2, 0) == Float3{0, -1, 0});
    CHECK(normal(2, 1) == Float3{1, 0, 0});
    CHECK(normal(2, 2) == Float3{0, -1, 0});
}

TEST_CASE("OBJ: polygons are cut without overlap, and all triangles bear their face's number", "[io][obj]") {
    const Model model = load("v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 .2 0\nv 0 2 0\nf 1 2 3\nf 1 2 3 4 5\nf 3 4 5\n");
    CHECK(model.faces == 3);
    CHECK(data_of(model).faces == std::vector<std::uint32_t>{0, 1, 1, 1, 2});
    CHECK(total_area(model) == Approx(2 + 2.2 + 1.8).epsilon(1e-6));
    CHECK(model.meshes[0]->face(3) == 1);
}

TEST_CASE("OBJ: faces without three corners or an area are dropped and counted, and keep their number", "[io][obj]") {
    const Model model = load(kSquare + "v 2 2 0\nf 1 2\nf\nf 1 1 2\nf 1 2 3\nf 4\nf 1 3 5\nf 1 3 5 4\n");
    CHECK(model.faces == 7);
    CHECK(model.dropped_faces == 5);
    CHECK(data_of(model).faces == std::vector<std::uint32_t>{3, 6, 6});
    CHECK(model.degenerate_triangles == 2);
}

TEST_CASE("OBJ: a decimal next to the middle of two float32 goes to the nearer one", "[io][obj]") {
    const MeshData d =
        data_of(load("v 1.00000005960464477539062500000000000000001 1e-60 -0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    CHECK(d.vertices[0].x == 0x1.000002p0f);
    CHECK(bits(d.vertices[0].y) == bits(0.0f));
    CHECK(bits(d.vertices[0].z) == bits(-0.0f));
}

TEST_CASE("OBJ: a model of a millionth of the size is the same model", "[io][obj]") {
    const auto scaled = [](const char* exponent) {
        const std::string e = exponent;
        return load("v 0 0 0\nv 2" + e + " 0 0\nv 2" + e + " 2" + e + " 0\nv 1" + e + " .25" + e + " 0\nv 0 2" + e +
                    " 0\nf 1 2 3 4 5\n");
    };
    const Model one = scaled("e0");
    for (const char* exponent : {"e-30", "e-6", "e6", "e30"}) {
        const Model model = scaled(exponent);
        CHECK(data_of(model).triangles == data_of(one).triangles);
        CHECK(model.degenerate_triangles == 0);
        CHECK(model.bounds().upper.x == static_cast<double>(*parse_float("2" + std::string(exponent))));
    }
}

TEST_CASE("OBJ: groups, objects, smoothing, lines and points are accepted, what is unknown is reported", "[io][obj]") {
    const Model known = load("o thing\ng a b\ns off\n" + kTriangle + "l 1 2\np 1\ns 1\nf 1 2 3\ng\n");
    CHECK(known.warnings.empty());
    CHECK(known.faces == 1);
    const Model unknown = load(kTriangle + "vp 1 2\ncurv 0 1 1 2\nf 1 2 3\n");
    REQUIRE(unknown.warnings.size() == 1);
    CHECK(unknown.warnings[0] == "2 lines were passed over; the first is line 4");
}

TEST_CASE("OBJ: a weight or a colour behind the coordinates is not used", "[io][obj]") {
    const MeshData d = data_of(load("v 0 0 0 1\nv 1 0 0 .5 .5 .5\nv 0 1 0 1 1 1 1\nf 1 2 3\n"));
    CHECK(d.vertices == std::vector<Float3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
}

}  // namespace limn::obj_forms_test
