// The tables of docs/models.md, line by line.
#include <array>
#include <cmath>

#include "catch.h"
#include "limn/io/image_io.h"
#include "limn/io/obj.h"
#include "limn/math/error.h"
#include "limn/records/record_sink.h"
#include "limn/scene/material/dielectric.h"
#include "limn/scene/material/lambertian.h"
#include "limn/scene/material/metallic_roughness.h"
#include "limn/scene/material/plastic.h"
#include "limn/scene/material/rough_conductor.h"
#include "limn/scene/material/rough_dielectric.h"
#include "lowered_material.h"
#include "support/folder.h"

namespace limn::obj_materials_test {

using namespace test;

namespace {

// One triangle in each of the planes z = 0, 1, 2, ..., of the given materials.
std::string triangles(const std::vector<std::string>& materials) {
    std::string text = "mtllib a.mtl\nvt 0 0\n";
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const std::string z = std::to_string(i);
        if (!materials[i].empty()) text += "usemtl " + materials[i] + "\n";
        text += "v 0 0 " + z + "\nv 1 0 " + z + "\nv 0 1 " + z + "\nf -3/1 -2/1 -1/1\n";
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
        const MaterialRecord& m = materials.at(i);
        const TextureId id = m.emission != TextureId::none ? m.emission : m.albedo;
        return sink.records().textures.at(static_cast<std::uint32_t>(id));
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

TEST_CASE("MTL: illum decides what a material is, Ke before it", "[io][obj][mtl]") {
    constexpr std::string_view kMatte = "lambertian", kGlass = "rough-dielectric", kClear = "dielectric",
                               kPlastic = "plastic", kMetal = "rough-conductor", kMixture = "metallic-roughness";
    struct Row {
        std::string mtl;
        std::string_view kind;
        Color color;
        double index = 0, alpha = 0, opacity = 1;
        std::vector<std::string> unused{};  // words that a warning names, with their lines
    };
    const Row rows[] = {
        {"illum 0\nKd .5 .25 1\n", kMatte, {.5, .25, 1}},
        {"illum 1\nKd .5 .25 1\nKs 1 1 1\nNs 9\n", kMatte, {.5, .25, 1}},
        {"illum 1\nKd .5 .25 1\nPr .5\n", kMatte, {.5, .25, 1}, 0, 0, 1, {"4: Pr"}},
        {"illum 2\nKd .5 .25 1\nKs 0 0 0\n", kMatte, {.5, .25, 1}},
        {"illum 2\nKd .5 .5 .5\nKs .25 .25 .25\nNs 6\n", kPlastic, {.5, .5, .5}, 1.5, 0.5},
        {"illum 2\nKd .5 .5 .5\nKs .25 .25 .25\nNs 6\nPr .5\n", kPlastic, {.5, .5, .5}, 1.5, 0.25},
        {"illum 2\nKd .5 .5 .5\nKs .25 .25 .25\n", kPlastic, {.5, .5, .5}, 1.5, 1},
        // As Blender writes them: never a grey mirror, nor clear glass.
        {"Ns 198\nKa 1 1 1\nKd .125 .25 .5\nKs .5 .5 .5\nKe 0 0 0\nNi 1.45\nd 1\nillum 2\n",
         kPlastic,
         {.125, .25, .5},
         1.45,
         0.1},
        {"Kd .125 .25 .5\nKs .5 .5 .5\nNs 6\nd .75\nillum 2\n", kPlastic, {.125, .25, .5}, 1.5, .5, .75},
        {"illum 3\nKd .5 .5 .5\nKs .25 .5 .25\nNs 1022\n", kMetal, {.25, .5, .25}, 0, 0.04419417382415922},
        {"illum 5\nKs 1 1 1\nNs 0\n", kMetal, {1, 1, 1}, 0, 1},
        {"illum 8\nKs 1 1 1\nNs 6\n", kMetal, {1, 1, 1}, 0, 0.5},
        {"illum 3\nKs 1 1 1\nNs -5\n", kMetal, {1, 1, 1}, 0, 1},
        {"illum 3\nKs 1 1 1\nNs 6\nPr 0\n", kMetal, {1, 1, 1}, 0, 0},
        {"illum 3\nKs 1 1 1\nNs 6\nd .5\n", kMetal, {1, 1, 1}, 0, .5, .5},
        {"illum 3\nKd .5 .25 1\nKs 0 0 0\n", kMatte, {.5, .25, 1}, 0, 0, 1, {"2: illum"}},
        {"illum 4\nKd 1 1 1\n", kClear, {}, 1.5},
        {"illum 6\nNi 2\n", kClear, {}, 2},
        {"illum 7\nNi 0.5\nKs 1 1 1\n", kClear, {}, 1.5},
        {"illum 7\nNi 2\nPr .5\nPm 1\n", kGlass, {}, 2, .25, 1, {"5: Pm"}},
        {"illum 9\nNi 2\nd .25\n", kClear, {}, 2},
        {"illum 10\nKd .5 .25 1\n", kMatte, {.5, .25, 1}, 0, 0, 1, {"2: illum"}},
        {"illum 2\nKd .5 .25 1\nKs .5 .5 .5\nPr .5\nPm .25\n", kMixture, {.5, .25, 1}, 1.5, .5},
        {"illum 3\nKd .5 .25 1\nKs .5 .5 .5\nPr .5\nPm 1\nNi 1.5\n", kMetal, {.5, .25, 1}, 0, .25},
        {"Kd .5 .25 1\nPm 0\nPr 0\nNi 1.4\n", kPlastic, {.5, .25, 1}, 1.4, 0},
        {"Kd 0.5 0.25 1\n", kMatte, {0.5, 0.25, 1}},
        {"Kd 0.5\n", kMatte, {0.5, 0.5, 0.5}},
        {"Kd .5 .5 .5\nKs .25 .25 .25\nNs 6\n", kPlastic, {.5, .5, .5}, 1.5, .5},
        {"Kd .25 .25 .25\nKs .5 .5 .5\nNs 6\n", kMetal, {.5, .5, .5}, 0, 0.5},
        {"d 0.5\nNi 1.25\nKd 1 0 1\n", kMatte, {1, 0, 1}, 0, 0, 0.5},
        {"d -halo 0.5\nKd 1 0 1\n", kMatte, {1, 0, 1}, 0, 0, 0.5},
        {"Tr 0.25\nKd 1 0 1\n", kMatte, {1, 0, 1}, 0, 0, 0.75},
        {"Tr 0\nKd 1 0 1\nNi 1.5\n", kMatte, {1, 0, 1}},
        {"d 1\nTr 1\nKd 1 0 1\n", kMatte, {1, 0, 1}},
        {"Tr 1\nd 1\nKd 1 0 1\n", kMatte, {1, 0, 1}},
        {"illum 1\nTr 0.5\nKd 1 0 1\n", kMatte, {1, 0, 1}, 0, 0, 0.5},
        {"Ke 4 2 1\nKd 1 1 1\nd 0.5\nillum 3\n", "diffuse-light", {4, 2, 1}, 0, 0, 1, {"4: d", "5: illum"}},
        {"Ke 4 2 1\nKs 1 1 1\nillum 2\n", "diffuse-light", {4, 2, 1}},
        {"Ke 4 2 1\nmap_Kd none.png\nbump none.png\n", "diffuse-light", {4, 2, 1}, 0, 0, 1, {"3: map_Kd", "4: bump"}},
        {"Ke 0 0 0\nKd 1 1 1\n", kMatte, {1, 1, 1}},
    };
    const Folder folder;
    for (const Row& row : rows) {
        CAPTURE(row.mtl);
        const Model model = load_one(folder, row.mtl);
        const LoweredMaterial lowered(model);
        std::vector<std::string> warnings;
        for (const std::string& word : row.unused)
            warnings.push_back(folder.path("a.mtl") + ": line " + word + " of material 'm' is not used");
        CHECK(model.warnings == warnings);
        CHECK(lowered.record.kind == row.kind);
        const LobeParameters& p = lowered.record.parameters;
        const auto check = [&row = row](double index, double alpha) {
            CHECK(index == Approx(row.index).epsilon(1e-7));  // a float32
            CHECK(alpha == Approx(row.alpha).epsilon(1e-12));
        };
        if (row.kind == kClear) check(p.as<Dielectric::Parameters>().index, 0);
        if (row.kind == kGlass)
            check(p.as<RoughDielectric::Parameters>().index, p.as<RoughDielectric::Parameters>().alpha_x);
        if (row.kind == kPlastic) check(p.as<Plastic::Parameters>().index, p.as<Plastic::Parameters>().alpha_x);
        if (row.kind == kMetal) check(0, p.as<RoughConductor::Parameters>().alpha_x);
        if (row.kind == kMixture) {
            const auto mixture = p.as<MetallicRoughness::Parameters>();
            check(mixture.index, mixture.roughness);  // Pr itself
            CHECK(mixture.metallic == .25);
        }
        if (row.kind != kGlass && row.kind != kClear) check_color(lowered.color(), row.color);
        CHECK(lowered.opacity() == row.opacity);
    }
    CHECK(load_one(folder, "d 0\n").warnings == std::vector<std::string>{"material 'm' is invisible: its d is 0"});
}

TEST_CASE("MTL: what has map_Kd shows it, whatever else the material says", "[io][obj][mtl]") {
    const Folder folder;
    save_image(Image(1, 1, Color{0.5, 0.25, 0.125}), folder.path("a.png"));
    struct Row {
        std::string rest;
        std::string_view kind;
        double opacity = 1;
        std::vector<std::string> unused{};
    };
    const Row rows[] = {{"Ks .5 .5 .5\nillum 2\n", "plastic"},
                        {"d .75\nillum 2\n", "lambertian", .75},
                        {"Ks 1 1 1\nillum 3\n", "plastic", 1, {"illum"}},
                        {"d .75\nillum 9\n", "lambertian", .75, {"illum"}},
                        {"d .75\n", "lambertian", .75},
                        {"Pm 1\nPr .5\nillum 3\n", "rough-conductor"},
                        {"Pm .5\nPr .5\nmap_Ks a.png\n", "metallic-roughness", 1, {"map_Ks"}},
                        {"illum 1\n", "lambertian"}};
    for (const auto& [rest, kind, opacity, unused] : rows) {
        CAPTURE(rest);
        const Model model = load_one(folder, "map_Kd a.png\n" + rest);
        const LoweredMaterial lowered(model);
        CHECK(lowered.record.kind == kind);
        CHECK(lowered.texture(lowered.record.albedo).kind == TextureKind::image);
        CHECK(lowered.opacity() == opacity);
        REQUIRE(model.warnings.size() == unused.size());
        for (std::size_t i = 0; i < unused.size(); ++i)
            CHECK(model.warnings[i].ends_with(": " + unused[i] + " of material 'm' is not used"));
    }
}

TEST_CASE("MTL: each word that is not used gives one warning, however many materials have it", "[io][obj][mtl]") {
    const Folder folder;
    const std::string both = "Kd 1 1 1\nmap_Pr b.png\nPs .5\nmap_Pr b.png\n";
    folder.write("a.mtl", "newmtl a\n" + both + "newmtl b\n" + both + "Pc 1\nnewmtl c\nmap_Pr b.png\n" +
                              "newmtl unused\ndisp d.png\n");
    const Model model = load_obj(folder.write("a.obj", triangles({"a", "b", "c"})));
    const std::string at = folder.path("a.mtl") + ": line ";
    CHECK(model.warnings ==
          std::vector<std::string>{at + "3: map_Pr of material 'a' is not used, nor in 2 other materials",
                                   at + "4: Ps of material 'a' is not used, nor in one other material",
                                   at + "11: Pc of material 'b' is not used"});
}

TEST_CASE("MTL: a file of many unknown words does not flood the warnings", "[io][obj][mtl]") {
    const Folder folder;
    std::string words;
    for (int i = 0; i < 1000; ++i) words += "word" + std::to_string(i) + " 1\n";
    const Model model = load_one(folder, words);
    CHECK(model.warnings.size() == 21);
    CHECK(model.warnings.back() == folder.path("a.mtl") + ": line 22: other words of material 'm' are not used");
}

TEST_CASE("MTL: map_Kd is an image beside the MTL, v upward, repeated, decoded from sRGB", "[io][obj][mtl]") {
    const Folder folder;
    std::filesystem::create_directories(folder.path("mats/my maps"));
    save_image(Image(2, 1, Color{0.5, 0.25, 0.125}), folder.path("mats/my maps/wood 1.png"));
    folder.write("mats/b.mtl", "\xef\xbb\xbfnewmtl oak\r\nKd 1 0 0\r\nmap_Kd my maps\\wood 1.png\r\n");
    const std::string obj = "mtllib mats\\b.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl oak\nf 1/1 2/1 3/1\n";
    const Model model = load_obj(folder.write("a.obj", obj));
    CHECK(model.warnings.empty());
    const Lowered lowered(model);
    CHECK(lowered.materials[0].kind == "lambertian");
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
    CHECK(model.warnings[0] ==
          folder.path("a.mtl") + ": line 5: material 'red' is defined twice; the first definition is used");
    const auto glass = std::make_shared<Dielectric>(1.5);
    const Lowered with_default(load_obj(folder.path("a.obj"), {.default_material = glass}));
    CHECK(with_default.materials[0].kind == "dielectric");
}

TEST_CASE("MTL: a material that an earlier library has is left out with a warning", "[io][obj][mtl]") {
    const Folder folder;
    folder.write("b.mtl", "newmtl red\nKd 1 0 0\n");
    folder.write("a.mtl", "newmtl green\nKd 0 1 0\nnewmtl red\nKd 0 0 1\n");
    const Model model = load_obj(folder.write("a.obj", "mtllib b.mtl\n" + triangles({"red", "green"})));
    check_color(Lowered(model).color(0), Color{1, 0, 0});
    check_color(Lowered(model).color(1), Color{0, 1, 0});
    CHECK(model.warnings ==
          std::vector<std::string>{folder.path("a.mtl") +
                                   ": line 3: material 'red' is defined twice; the first definition is used"});
}

TEST_CASE("MTL: a library that is named twice is read once", "[io][obj][mtl]") {
    const Folder folder;
    folder.write("a.mtl", "newmtl red\nKd 1 0 0\nnewmtl red\n");
    folder.write("bad.mtl", "II*" + std::string(20, '\0'));
    const Model model =
        load_obj(folder.write("a.obj", "mtllib a.mtl\nmtllib bad.mtl\nmtllib a.mtl bad.mtl\n" + triangles({"red"})));
    check_color(Lowered(model).color(0), Color{1, 0, 0});
    CHECK(model.files == std::vector<std::string>{folder.path("a.obj"), folder.path("a.mtl"), folder.path("bad.mtl")});
    CHECK(model.warnings ==
          std::vector<std::string>{
              folder.path("bad.mtl") + ": is no material library: it appears to be a TIFF picture",
              folder.path("a.mtl") + ": line 3: material 'red' is defined twice; the first definition is used"});
}

TEST_CASE("MTL: a missing library, material or texture is a warning, not an error", "[io][obj][mtl]") {
    const Folder folder;
    const auto warning = [](const Model& model) { return model.warnings.empty() ? "" : model.warnings[0]; };
    // It stands before all that is wrong elsewhere.
    const Model no_library = load_obj(folder.write("a.obj", "curv 1\n" + triangles({"red", "red"})));
    CHECK(no_library.warnings ==
          std::vector<std::string>{folder.path("a.mtl") + ": there is no such material library, which line 2 of " +
                                       folder.path("a.obj") +
                                       " names; faces with its materials get the default material",
                                   "1 line was passed over; the first is line 1", "unknown material 'red'"});
    check_color(Lowered(no_library).color(0), Color{0.5, 0.5, 0.5});

    const Model unknown = load_obj(folder.write("a.obj", triangles({"a", "b", "c", "d", "e"})));
    CHECK(unknown.warnings.size() == 5);
    CHECK(unknown.warnings.back() == "and 2 more unknown materials");

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

TEST_CASE("MTL: a material with a picture on faces without texture coordinates gives one warning", "[io][obj][mtl]") {
    const Folder folder;
    save_image(Image(1, 1), folder.path("a.png"));
    load_one(folder, "Kd 1 1 1\nmap_Kd a.png\n");
    const std::string square = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nusemtl m\n";
    const Model none = load_obj(folder.write("b.obj", square + "f 1/1 2/1 3/1\nf 1/1 2 3\nf 2 3 4\n"));
    CHECK(none.warnings ==
          std::vector<std::string>{"material 'm' has pictures, but its face of line 9 has no texture coordinates"});
    CHECK(load_obj(folder.write("b.obj", square + "f 1/1 2/1 3/1\n")).warnings.empty());
    CHECK(load_obj(folder.path("b.obj"), {.textures = false}).warnings.empty());
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
    for (const std::string line :
         {"Kd a b c", "Kd 1 1 nan", "Ke 1e40 0 0", "Ns", "Ni 1,5", "d x", "Pr x", "bump -bm x b.png", "illum two"}) {
        CAPTURE(line);
        std::string message = "accepted";
        try {
            load_one(folder, "# comment\n" + line + "\n");
        } catch (const FileError& error) {
            message = error.what();
        }
        CHECK(message.starts_with(folder.path("a.mtl") + ": line 3: "));
    }
    CHECK(load_one(folder, "Ka x\nKd spectral a.rfl\nunknown nan\n").warnings.size() == 2);  // Ka is never used
}

}  // namespace limn::obj_materials_test
