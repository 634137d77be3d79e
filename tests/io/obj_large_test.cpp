// Models that are large in one respect.
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <random>

#include "catch.h"
#include "formats.h"
#include "geometry/mesh_triangle.h"
#include "io/obj_reader.h"
#include "io/text_lines.h"
#include "limn/math/error.h"
#include "limn/math/math.h"

namespace limn::obj_large_test {

using namespace test;

namespace {

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

MeshData load(const std::string& text) {
    Model model;
    return build_mesh(parse_obj(text, "large.obj", model), model);
}

void append_row(std::string& text, const char* key, std::initializer_list<double> values) {
    text += key;
    for (const double v : values) text += ' ', append_number(text, static_cast<float>(v));
    text += '\n';
}

}  // namespace

TEST_CASE("Large OBJ: a face of 300,000 corners is one face", "[io][obj]") {
    constexpr int kCorners = 300'000;
    std::string text, face = "f";
    for (int i = 0; i < kCorners; ++i) {
        const double angle = i * (2 * kPi / kCorners);
        append_row(text, "v", {std::cos(angle), std::sin(angle), 0});
        face += ' ' + std::to_string(i + 1);
    }
    Model model;
    const ObjFile file = parse_obj(text + "f 1 100000 200000\n" + face + "\nf 2 100002 200002\n", "large.obj", model);
    REQUIRE(file.faces.size() == 3);
    CHECK(file.faces[1].corner_count == kCorners);
    CHECK(file.corners[file.faces[1].first_corner + 1000].position == 1000);
    const MeshData mesh = build_mesh(file, model);
    CHECK(model.dropped_faces == 0);
    CHECK(mesh.triangles.size() + model.degenerate_triangles == kCorners);  // two more faces, two less
    double area = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (mesh.faces[i] != 1) continue;
        const Index3 t = mesh.triangles[i];
        const Point3 a = to_point(mesh.vertices[t.a]);
        area += length(cross(to_point(mesh.vertices[t.b]) - a, to_point(mesh.vertices[t.c]) - a)) / 2;
    }
    CHECK(area == Approx(kPi).epsilon(1e-6));
}

TEST_CASE("Large OBJ: one vertex may be shared by 100,000 faces of different normals", "[io][obj]") {
    constexpr int kFaces = 100'000;
    std::string text = "v 0 0 1\n";
    for (int i = 0; i < kFaces; ++i) {
        const double angle = i * (2 * kPi / kFaces);
        append_row(text, "v", {std::cos(angle), std::sin(angle), 0});
    }
    for (int i = 0; i < kFaces; ++i) {
        const std::string normal = "//" + std::to_string(i + 1);
        append_row(text, "vn", {1, static_cast<double>(i), 0});
        text += "f 1" + normal + ' ' + std::to_string(2 + i) + normal + ' ' + std::to_string(2 + (i + 1) % kFaces) +
                normal + '\n';
    }
    const MeshData mesh = load(text);
    CHECK(mesh.triangles.size() == kFaces);
    CHECK(mesh.vertices.size() == 3 * kFaces);
}

TEST_CASE("Large OBJ: lines of millions of characters are read, and messages stay short", "[io][obj]") {
    const std::string blanks(2'000'000, ' '), word(2'000'000, '7');
    CHECK(load(kTriangle + "f 1" + blanks + "2 3" + blanks + "\n").triangles.size() == 1);
    CHECK(load("#" + word + "\n" + kTriangle + "f 1 2 3 #" + word).triangles.size() == 1);
    CHECK(load(kTriangle + word + "\ng " + word + "\nusemtl " + word + "\nf 1 2 3\n").triangles.size() == 1);
    CHECK(load(kTriangle + "v 0." + word + " 0 0\nf 1 2 3\n").triangles.size() == 1);
    for (const std::string& line : {"v " + word + " 0 0", "f 1 2 " + word, "f 1 2 " + word + "/////"}) try {
            load(kTriangle + line);
            FAIL("accepted");
        } catch (const FileError& error) {
            const std::string message = error.what();
            CHECK(message.starts_with("large.obj: line 4: "));
            CHECK(message.size() < 200);
        }
}

TEST_CASE("Large OBJ: coordinates printed with 9 digits are read bit for bit", "[io][obj]") {
    const std::size_t count = std::getenv("LIMN_FULL") ? 999'999 : 9'999;
    std::mt19937 generator(87);
    std::vector<float> values;
    while (values.size() < count) {
        const float v = std::bit_cast<float>(static_cast<std::uint32_t>(generator()));
        if (std::isfinite(v)) values.push_back(v);
    }
    std::string text = kTriangle + "f 1 2 3\n";
    for (std::size_t i = 0; i < count; ++i) {
        char digits[32];
        const auto [end, error] = std::to_chars(digits, digits + 32, values[i], std::chars_format::general, 9);
        text += i % 3 == 0 ? "\nv " : " ";
        text.append(digits, end);
    }
    Model model;
    const std::vector<Float3> read = parse_obj(text, "large.obj", model).positions;
    REQUIRE(read.size() == 3 + count / 3);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Float3& v = read[3 + i / 3];
        wrong += bits(i % 3 == 0 ? v.x : i % 3 == 1 ? v.y : v.z) != bits(values[i]);
    }
    CHECK(wrong == 0);
}

}  // namespace limn::obj_large_test
