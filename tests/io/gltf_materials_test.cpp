// What becomes of a glTF's materials: the table of docs/models.md.
#include <cmath>

#include "gltf_files.h"
#include "limn/math/vec.h"
#include "limn/scene/material/dielectric.h"
#include "limn/scene/material/metallic_roughness.h"
#include "limn/scene/material/plastic.h"
#include "limn/scene/material/rough_conductor.h"
#include "limn/scene/material/rough_dielectric.h"
#include "lowered_material.h"

namespace limn::gltf_materials_test {

using namespace test;

TEST_CASE("glTF: factors and the index are those of the material", "[io][gltf]") {
    const auto lowered = [](const std::string& factors, const std::string& extensions = "{}") {
        return LoweredMaterial(
            load(with_material("\"pbrMetallicRoughness\": {" + factors + "}, \"extensions\": " + extensions)));
    };
    const auto ior = [](double n) { return R"({"KHR_materials_ior": {"ior": )" + std::to_string(n) + "}}"; };
    const LoweredMaterial mixture = lowered(R"("metallicFactor": 0.25, "roughnessFactor": 0.5)", ior(1.25));
    CHECK(mixture.record.kind == "metallic-roughness");
    const auto mixed = mixture.record.parameters.as<MetallicRoughness::Parameters>();
    CHECK((mixed.index == 1.25 && mixed.metallic == 0.25 && mixed.roughness == 0.5));
    const LoweredMaterial plastic = lowered(R"("metallicFactor": 0, "roughnessFactor": 0.5)", ior(0));
    CHECK(plastic.record.parameters.as<Plastic::Parameters>().index == 1.5);
    CHECK(plastic.record.parameters.as<Plastic::Parameters>().alpha_x == 0.25);
    const MaterialRecord smooth = lowered(R"("metallicFactor": 0, "roughnessFactor": 0)").record;
    CHECK(smooth.parameters.as<Plastic::Parameters>().alpha_x == 0);
    CHECK(lowered(R"("roughnessFactor": 0)").record.specular);  // a mirror
}

TEST_CASE("glTF: what transmits half of its light or more is glass, as rough as it says", "[io][gltf]") {
    const auto glass = [](double factor, const std::string& base) {
        return load(with_material("\"pbrMetallicRoughness\": {" + base +
                                  R"(}, "extensions": {"KHR_materials_transmission": {"transmissionFactor": )" +
                                  std::to_string(factor) + "}, \"KHR_materials_ior\": {\"ior\": 1.25}}"));
    };
    const std::string smooth = R"("metallicFactor": 0, "roughnessFactor": 0)";
    const Model clear = glass(1, smooth), rough = glass(1, R"("metallicFactor": 0, "roughnessFactor": 0.5)");
    CHECK(LoweredMaterial(clear).record.kind == "dielectric");
    CHECK(LoweredMaterial(clear).record.parameters.as<Dielectric::Parameters>().index == 1.25);
    CHECK(clear.warnings.empty());
    CHECK(LoweredMaterial(rough).record.kind == "rough-dielectric");
    CHECK(LoweredMaterial(rough).record.parameters.as<RoughDielectric::Parameters>().alpha_x == 0.25);
    CHECK(is_of<RoughConductor>(glass(1, "\"roughnessFactor\": 0")));  // of metal nothing transmits
    CHECK(is_of<Plastic>(glass(0.25, smooth)));
    CHECK(glass(0.75, R"("metallicFactor": 0, "baseColorFactor": [1, 0, 0, 1])").warnings ==
          std::vector<std::string>{"the exact share of transmitted light of material 'material 0' is not used",
                                   "baseColorFactor of material 'material 0' is not used"});
}

TEST_CASE("glTF: alphaMode says what the alpha of the base colour means", "[io][gltf]") {
    const Folder folder;
    Image image(2, 1, {1, 1, 1});
    save_image(image, folder.path("a.png"), {.alpha = {0.25F, 0.75F}});
    const auto mask = [&](const std::string& mode, const std::string& base, bool has_picture) {
        const std::string material = "\"alphaMode\": " + mode + R"(, "pbrMetallicRoughness": {"metallicFactor": 0)" +
                                     base + (has_picture ? R"(, "baseColorTexture": {"index": 0}})" : "}");
        return LoweredMaterial(load_model(folder.write("a.gltf", with_texture("\"uri\": \"a.png\"", material))));
    };
    const std::string half = R"(, "baseColorFactor": [1, 1, 1, 0.5])";
    CHECK(mask("\"OPAQUE\"", half, true).record.opacity == TextureId::none);
    CHECK(mask("\"BLEND\"", "", false).record.opacity == TextureId::none);
    CHECK(mask("\"BLEND\"", half, false).opacity(0.25) == 0.5);
    CHECK(mask("\"BLEND\"", half, true).opacity(0.25) == Approx(0.125).margin(0.002));
    CHECK(mask("\"BLEND\"", half, true).opacity(0.75) == Approx(0.375).margin(0.002));
    CHECK(mask("\"BLEND\"", "", true).record.opacity_cutoff == 0);
    CHECK(mask("\"MASK\"", "", true).opacity(0.75) == Approx(0.75).margin(0.002));
    CHECK(mask("\"MASK\"", "", true).record.opacity_cutoff == 0.5);
    CHECK(mask(R"("MASK", "alphaCutoff": 0.25)", "", true).record.opacity_cutoff == 0.25);
    CHECK(mask("\"MASK\"", half, false).record.opacity == TextureId::none);
    CHECK(mask(R"("MASK", "alphaCutoff": 0.75)", half, false).opacity(0.25) == 0);
    CHECK(mask(R"("MASK", "alphaCutoff": 0)", half, true).record.opacity == TextureId::none);
}

TEST_CASE("glTF: pictures of normals and of roughness are read as they are, and each one once", "[io][gltf]") {
    const Folder folder;
    // What is stored is 0.5 and the like, to 8 bits.
    save_image(Image(1, 1, {srgb_decode(0.75), srgb_decode(0.5), srgb_decode(0.25)}), folder.path("a.png"));
    const std::string all = R"("normalTexture": {"index": 0, "scale": 0.5}, "pbrMetallicRoughness": {
"baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 0}, "roughnessFactor": 0.5})";
    const Model model = load_model(folder.write("a.gltf", with_texture("\"uri\": \"a.png\"", all)));
    CHECK(model.warnings.empty());
    CHECK(model.files == std::vector<std::string>{folder.path("a.gltf"), folder.path("a.png")});
    const LoweredMaterial lowered(model);
    CHECK(lowered.record.kind == "metallic-roughness");
    CHECK(lowered.record.parameters.as<MetallicRoughness::Parameters>().roughness == 0.5);
    CHECK(lowered.record.parameters.as<MetallicRoughness::Parameters>().metallic == 1);
    const Color base = lowered.color(), raw = lowered.at(lowered.record.factors, 0.5, 0.5),
                bent = lowered.at(lowered.record.normal_map, 0.5, 0.5);
    CHECK(distance(base, {srgb_decode(0.75), srgb_decode(0.5), srgb_decode(0.25)}) < 0.015);
    CHECK(distance(raw, {0.75, 0.5, 0.25}) < 0.015);
    const Vec3 normal = normalize(Vec3{0.25, 0, -0.5});  // half of 0.5, and as deep as before
    CHECK(distance(bent, {0.5 + normal.x / 2, 0.5 + normal.y / 2, 0.5 + normal.z / 2}) < 0.015);

    const std::string moved =
        replaced(all, R"("normalTexture": {"index": 0,)", R"("normalTexture": {"index": 0, "texCoord": 1,)");
    CHECK(load_model(folder.write("a.gltf", with_texture("\"uri\": \"a.png\"", moved))).warnings ==
          std::vector<std::string>{"the texCoord or KHR_texture_transform of normalTexture of material 'material 0' "
                                   "is not used"});
}

TEST_CASE("glTF: materials that show the same picture share it", "[io][gltf]") {
    const Folder folder;
    four_pixels(folder);
    const std::string two =
        replaced(with_texture("\"uri\": \"four.png\""), "\"materials\": [{", "\"materials\": [{" + kTextured + "}, {");
    const Model model = load_model(folder.write("a.gltf", two));
    RecordSink sink;
    for (const std::size_t i : {1U, 2U}) lower_material(sink, model.meshes.at(0)->materials().at(i));
    CHECK(sink.records().images.size() == 1);
}

TEST_CASE("glTF: pictures without texture coordinates, and a wrapT of its own, give a warning", "[io][gltf]") {
    const Folder folder;
    const std::string textured = with_texture("\"uri\": \"" + data_uri(four_pixels(folder), "image/png") + "\"");
    CHECK(load(textured).warnings.empty());
    CHECK(load(replaced(textured, ", \"TEXCOORD_0\": 1", "")).warnings ==
          std::vector<std::string>{"material 'material 0' has pictures, but triangles of it have no TEXCOORD_0"});
    CHECK(load(replaced(textured, "{\"magFilter\"", "{\"wrapS\": 33071, \"wrapT\": 33071, \"magFilter\""))
              .warnings.empty());
    CHECK(load(replaced(textured, "{\"magFilter\"", "{\"wrapT\": 33071, \"magFilter\"")).warnings ==
          std::vector<std::string>{"a wrapT other than its wrapS of material 'material 0' is not used"});
}

}  // namespace limn::gltf_materials_test
