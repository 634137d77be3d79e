// Files that break off or are damaged: each is refused with the file's name and the line at fault, or loads with every
// index in range and every coordinate finite.
#include "broken_models.h"
#include "io/text_lines.h"
#include "limn/io/obj.h"
#include "support/meshes.h"

namespace limn::obj_broken_test {

using namespace test;

namespace {

// As modelling programs write them: normals and texture coordinates for each vertex, groups, materials.
std::string textured_sphere() {
    const MeshData sphere = icosphere(2);
    std::string text = "# a sphere\nmtllib none.mtl\no sphere\n";
    const auto row = [&text](const char* key, std::initializer_list<float> values) {
        text += key;
        for (const float v : values) text += ' ', append_number(text, v);
        text += '\n';
    };
    for (const Float3& v : sphere.vertices) row("v", {v.x, v.y, v.z});
    for (const Float3& v : sphere.vertices) row("vt", {0.5f + v.x / 2, 0.5f + v.y / 2});
    for (const Float3& v : sphere.vertices) row("vn", {v.x, v.y, v.z});
    text += "s 1\nusemtl none\n";
    for (const Index3& t : sphere.triangles) {
        text += 'f';
        for (const std::uint32_t i : {t.a, t.b, t.c}) {
            const std::string number = std::to_string(i + 1);
            text += ' ' + number + '/' + number + '/' + number;
        }
        text += '\n';
    }
    return text;
}

}  // namespace

TEST_CASE("Broken OBJ: a missing file and what is no file are refused with their name", "[io][obj]") {
    const Folder folder;
    CHECK_THROWS_WITH(load_obj(folder.path("no_such.obj")), folder.path("no_such.obj") + ": there is no such file");
    CHECK_THROWS_WITH(load_obj(folder.path()), folder.path() + ": is a folder, not a file");
    CHECK_THROWS_WITH(load_obj(folder.make_pipe("pipe.obj")), folder.path("pipe.obj") + ": is not a regular file");
    CHECK_THROWS_WITH(load_obj("/dev/zero"), "/dev/zero: is not a regular file");
    CHECK_THROWS_WITH(load_obj(""), ": there is no such file");
}

TEST_CASE("Broken OBJ: a file that breaks off, or of which a byte is changed, is refused or sound", "[io][obj]") {
    check_damage({textured_sphere()}, 0, 1);
}

TEST_CASE("Broken OBJ: whatever characters are changed in a file, it is refused or sound", "[io][obj]") {
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
        const std::string fault = fault_of_model(text);
        loaded += fault.empty();
        CHECK((fault.empty() || fault.starts_with("line ") || fault.starts_with("has no usable face")));
    }
    CHECK(loaded > 2000);
    CHECK(loaded < 18'000);
}

}  // namespace limn::obj_broken_test
