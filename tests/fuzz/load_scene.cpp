// Whatever the bytes of a compiled scene's file are, reading it gives one or a FileError, or an Error where memory
// lacks. What is given changes the bytes of a file; the versions and checksums are made right, so that what is within
// reaches the reader.
#include <cstdint>
#include <cstring>
#include <memory>

#include "bsdf/albedo_table.h"
#include "core/read_file.h"
#include "limn/core/error.h"
#include "query/scene_file.h"
#include "scratch_file.h"
#include "support/film_bytes.h"

namespace {

std::string small_scene(const std::string& path) {
    limn::flat::Scene scene;
    std::get<0>(scene.rows).emplace_back(limn::SphereRecord{});
    scene.blases.resize(1), scene.ranges.resize(2), scene.nodes.resize(1), scene.blocks.resize(9);
    scene.name = "name";
    scene.materials.resize(2);
    scene.materials[0].kind = "lambertian";
    scene.materials[1].kind = "plastic";
    scene.materials[1].details = std::make_shared<limn::MaterialDetails>(
        limn::MaterialDetails{.albedo_table = std::make_shared<limn::bsdf::AlbedoTable>(
                                  limn::bsdf::AlbedoTable{.rows = 1, .albedo = {0.5, 0.5}, .mean = {0.5}})});
    scene.material_names = {std::make_shared<std::vector<std::string>>(1, "clay"), nullptr};
    scene.meshes.resize(1);
    scene.meshes[0].places = {1, 2};
    scene.images.push_back(std::make_shared<limn::Image>(2, 1));
    scene.environment.image = std::make_shared<limn::Image>(1, 2);
    limn::query::write_scene(scene, path);
    return limn::read_file(path);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::string path = limn::fuzz::scratch_path("scene"), start = small_scene(path);
    std::string bytes = start;
    if (size > bytes.size()) bytes.resize(size);
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>(bytes[i] ^ data[i]);
    const auto versions = limn::query::scene_file_versions();
    std::memcpy(&bytes[8], versions.data(), sizeof versions);
    limn::fuzz::write_file(path, limn::test::with_chunk_sums(bytes));
    limn::fuzz::attempt<limn::Error>([&] { limn::query::read_scene(path); });
    return 0;
}
