// The table of limn/io/obj.h, line by line.
#include <cmath>

#include "catch.h"
#include "limn/core/error.h"
#include "limn/io/image_io.h"
#include "limn/io/obj.h"
#include "limn/material/dielectric.h"
#include "limn/material/lambertian.h"
#include "limn/record_sink.h"
#include "support/folder.h"

using namespace limn;
using namespace limn::test;

namespace {

// One triangle in each of the planes z = 0, 1, 2, ..., of the given materials.
std::string triangles(const std::vector<std::string>& materials) {
    std::string text = "mtllib a.mtl\n";
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const std::string z = std::to_string(i);
        if (!materials[i].empty()) text += "usemtl " + materials[i] + "\n";
        text += "v 0 0 " + z + "\nv 1 0 " + z + "\nv 0 1 " + z + "\nf -3 -2 -1\n";
    }
    return text;
}

// What a model's materials lower to, by triangle.
struct Lowered {
    explicit Lowered(const Model& model) {
        model.meshes.at(0)->lower(sink);
        const MeshRecord& mesh = sink.records().meshes.at(0);
        for (const std::uint32_t slot : mesh.arrays.material_slots)
            materials.push_back(sink.records().materials.at(static_cast<std::uint32_t>(mesh.materials.at(slot))));
    }
    Color color(std::size_t i) const { return texture(i).color; }
    const TextureRecord& texture(std::size_t i) const {
        return sink.records().textures.at(static_cast<std::uint32_t>(materials.at(i).texture));
    }
    RecordSink sink;
    std::vector<MaterialRecord> materials;
};

void check_color(const Color& a, const Color& b) {
    CHECK(a.r == Approx(b.r).epsilon(1e-14));
    CHECK(a.g == Approx(b.g).epsilon(1e-14));
    CHECK(a.b == Approx(b.b).epsilon(1e-14));
}

Model load_one(const Folder& folder, const std::string& mtl) {
    folder.write("a.mtl", "newmtl m\n" + mtl);
    return load_obj(folder.write("a.obj", triangles({"m"})));
}

}  // namespace

TEST_CASE("MTL: each combination gives the material of the table", "[io][obj][mtl]") {
    struct Row {
        std::string mtl;
        MaterialKind kind;
        Color color;
        double parameter;
    };
    const Row rows[] = {
        {"Kd 0.5 0.25 1\n", MaterialKind::lambertian, {0.5, 0.25, 1}, 0},
        {"Kd 0.5\n", MaterialKind::lambertian, {0.5, 0.5, 0.5}, 0},
        {"Kd .5 .5 .5\nKs .25 .25 .25\nNs 100\nillum 2\n", MaterialKind::lambertian, {0.5, 0.5, 0.5}, 0},
        {"Ke 4 2 1\nKd 1 1 1\nd 0.5\nillum 3\n", MaterialKind::diffuse_light, {4, 2, 1}, 0},
        {"Ke 0 0 0\nKd 1 1 1\n", MaterialKind::lambertian, {1, 1, 1}, 0},
        {"d 0.5\nNi 1.25\n", MaterialKind::dielectric, {}, 1.25},
        {"d -halo 0.5\nNi 1.25\n", MaterialKind::dielectric, {}, 1.25},
        {"Tr 0.5\nNi 1\n", MaterialKind::dielectric, {}, 1.5},
        {"Tr 0\nKd 1 0 1\nNi 1.5\n", MaterialKind::lambertian, {1, 0, 1}, 0},
        {"d 1\nKd 1 0 1\nNi 1.5\n", MaterialKind::lambertian, {1, 0, 1}, 0},
        {"illum 4\nKd 1 1 1\n", MaterialKind::dielectric, {}, 1.5},
        {"illum 6\nNi 2\n", MaterialKind::dielectric, {}, 2},
        {"illum 7\nNi 0.5\nKs 1 1 1\n", MaterialKind::dielectric, {}, 1.5},
        {"illum 9\nNi 2\n", MaterialKind::dielectric, {}, 2},
        {"illum 3\nKd .5 .5 .5\nKs .25 .5 .25\nNs 1022\n", MaterialKind::metal, {.25, .5, .25}, 0.04419417382415922},
        {"illum 5\nKs 1 1 1\nNs 0\n", MaterialKind::metal, {1, 1, 1}, 1},
        {"illum 8\nKs 1 1 1\nNs 6\n", MaterialKind::metal, {1, 1, 1}, 0.5},
        {"Kd .25 .25 .25\nKs .5 .5 .5\nNs 6\n", MaterialKind::metal, {.5, .5, .5}, 0.5},
        {"illum 3\nKs 1 1 1\nNs -5\n", MaterialKind::metal, {1, 1, 1}, 1},
    };
    const Folder folder;
    for (const Row& row : rows) {
        CAPTURE(row.mtl);
        const Model model = load_one(folder, row.mtl);
        const Lowered lowered(model);
        CHECK(model.warnings.empty());
        CHECK(lowered.materials[0].kind == row.kind);
        CHECK(lowered.materials[0].parameter == Approx(row.parameter).epsilon(1e-12));
        if (row.kind != MaterialKind::dielectric) check_color(lowered.color(0), row.color);
    }
}

TEST_CASE("MTL: map_Kd is an image beside the MTL, v upward, repeated, decoded from sRGB", "[io][obj][mtl]") {
    const Folder folder;
    std::filesystem::create_directories(folder.path("mats/my maps"));
    save_image(Image(2, 1, Color{0.5, 0.25, 0.125}), folder.path("mats/my maps/wood 1.png"));
    folder.write("mats/b.mtl", "\xef\xbb\xbfnewmtl oak\r\nKd 1 0 0\r\nmap_Kd my maps\\wood 1.png\r\n");
    const std::string obj = "mtllib mats\\b.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl oak\nf 1 2 3\n";
    const Model model = load_obj(folder.write("a.obj", obj));
    CHECK(model.warnings.empty());
    const Lowered lowered(model);
    CHECK(lowered.materials[0].kind == MaterialKind::lambertian);
    const TextureRecord& texture = lowered.texture(0);
    CHECK(texture.kind == TextureKind::image);
    CHECK(texture.wrap == Wrap::repeat);
    CHECK(lowered.sink.records().images.at(texture.data)->at(1, 0).r == Approx(0.5).margin(0.005));
}

TEST_CASE("MTL: the name of a picture stands behind the options of map_Kd, whatever they are", "[io][obj][mtl]") {
    const Folder folder;
    save_image(Image(1, 1, Color{0.5, 0.25, 0.125}), folder.path("my -s 2.png"));
    for (const std::string options :
         {"-s 2", "-s 2 3", "-s 2 3 4", "-o .5 -t 1 1 1", "-mm 0 1", "-clamp on", "-blendu off -blendv off -cc on",
          "-bm 2 -imfchan r -texres 64 -boost 3 -type sphere -colorspace sRGB", "-s 2 # -o 1"}) {
        CAPTURE(options);
        const bool is_comment = options.find('#') != std::string::npos;
        const Model model = load_one(folder, "map_Kd " + options + " my -s 2.png\n");
        REQUIRE(model.warnings.size() == 1);
        CHECK(model.warnings[0] ==
              folder.path("a.mtl") + ": line 2: " +
                  (is_comment ? "map_Kd without the name of a file" : "the options of map_Kd are not used"));
        CHECK((Lowered(model).texture(0).kind == TextureKind::image) == !is_comment);
    }
}

TEST_CASE("MTL: the files of a model are the OBJ, every library and every texture, also broken ones",
          "[io][obj][mtl]") {
    const Folder folder;
    folder.write("bad.png", "no picture");
    const Model model = load_one(folder, "map_Kd bad.png\nnewmtl unused\nmap_Kd unused.png\n");
    CHECK(model.files == std::vector<std::string>{folder.path("a.obj"), folder.path("a.mtl"), folder.path("bad.png")});
}

TEST_CASE("MTL: faces keep their materials, those before any usemtl the default one", "[io][obj][mtl]") {
    const Folder folder;
    folder.write("a.mtl", "newmtl red\nKd 1 0 0\nnewmtl dark green\nKd 0 .5 0\nnewmtl red\nKd 0 0 1\n");
    const Model model = load_obj(folder.write("a.obj", triangles({"", "red", "dark green", "red"})));
    const Lowered lowered(model);
    check_color(lowered.color(0), Color{0.5, 0.5, 0.5});
    check_color(lowered.color(1), Color{1, 0, 0});  // the first of a name stays
    check_color(lowered.color(2), Color{0, 0.5, 0});
    check_color(lowered.color(3), Color{1, 0, 0});
    REQUIRE(model.warnings.size() == 1);
    CHECK(model.warnings[0] == folder.path("a.mtl") + ": line 5: material 'red' is there already; the first one stays");
    const auto glass = std::make_shared<Dielectric>(1.5);
    const Lowered with_default(load_obj(folder.path("a.obj"), {.default_material = glass}));
    CHECK(with_default.materials[0].kind == MaterialKind::dielectric);
}

TEST_CASE("MTL: a missing library, material or texture is a warning, not an error", "[io][obj][mtl]") {
    const Folder folder;
    const auto warning = [](const Model& model) { return model.warnings.empty() ? "" : model.warnings[0]; };
    const Model no_library = load_obj(folder.write("a.obj", triangles({"red", "red"})));
    CHECK(warning(no_library) == folder.path("a.mtl") + ": there is no such material library");
    CHECK(no_library.warnings.size() == 2);
    CHECK(no_library.warnings.back() == "unknown material 'red'");
    check_color(Lowered(no_library).color(0), Color{0.5, 0.5, 0.5});

    const Model no_texture = load_one(folder, "Kd .25 .5 .75\nmap_Kd none.png\n");
    CHECK(warning(no_texture) == folder.path("none.png") + ": there is no such file");
    check_color(Lowered(no_texture).color(0), Color{.25, .5, .75});

    folder.write("bad.png", "this is not a picture");
    const Model bad_texture = load_one(folder, "Kd .25 .5 .75\nmap_Kd bad.png\n");
    CHECK(warning(bad_texture).starts_with(folder.path("bad.png") + ": "));

    load_one(folder, "Kd 1 1 1\n");
    const Model odd_libraries =
        load_obj(folder.write("b.obj", "mtllib\nmtllib .\nmtllib a.mtl none.mtl\n" + triangles({"m"})));
    CHECK(odd_libraries.warnings.size() == 3);
    check_color(Lowered(odd_libraries).color(0), Color{1, 1, 1});
}

TEST_CASE("MTL: without textures no image is read, nor missed", "[io][obj][mtl]") {
    const Folder folder;
    load_one(folder, "Kd .25 .5 .75\nmap_Kd none.png\n");
    const Model model = load_obj(folder.path("a.obj"), {.textures = false});
    CHECK(model.warnings.empty());
    check_color(Lowered(model).color(0), Color{.25, .5, .75});
}

TEST_CASE("MTL: colours that no material may have are clamped, with a warning", "[io][obj][mtl]") {
    const Folder folder;
    const Model model = load_one(folder, "Kd 1.5 -1 .5\n");
    REQUIRE(model.warnings.size() == 1);
    CHECK(model.warnings[0] == "material 'm': Kd was clamped");
    check_color(Lowered(model).color(0), Color{1, 0, 0.5});
}

TEST_CASE("MTL: a malformed number is refused with the MTL's name and the line", "[io][obj][mtl]") {
    const Folder folder;
    for (const std::string line : {"Kd a b c", "Kd 1 1 nan", "Ke 1e40 0 0", "Ns", "Ni 1,5", "d x", "illum two"}) {
        CAPTURE(line);
        std::string message = "accepted";
        try {
            load_one(folder, "# comment\n" + line + "\n");
        } catch (const FileError& error) {
            message = error.what();
        }
        CHECK(message.starts_with(folder.path("a.mtl") + ": line 3: "));
    }
    CHECK(load_one(folder, "Ka x\nKd spectral a.rfl\nunknown nan\n").warnings.size() == 1);
}
