// Compiled scenes in files: what is written is read again; whatever is damaged, or of another version, is refused.
#include <cstring>

#include "catch.h"
#include "flat/tables.h"
#include "limn/core/error.h"
#include "limn/material/alpha_mask.h"
#include "limn/material/dielectric.h"
#include "limn/material/diffuse_light.h"
#include "limn/material/metal.h"
#include "limn/material/metallic_roughness.h"
#include "limn/material/normal_map.h"
#include "limn/material/oren_nayar.h"
#include "limn/material/plastic.h"
#include "limn/material/rough_conductor.h"
#include "limn/material/rough_dielectric.h"
#include "limn/query/compiled_scene.h"
#include "limn/render/first_hits.h"
#include "limn/shape/disk.h"
#include "limn/texture/checker.h"
#include "limn/texture/image_texture.h"
#include "limn/texture/perlin.h"
#include "support/folder.h"
#include "support/pictures.h"

namespace limn::scene_file_test {

using namespace test;

namespace {

// Every kind of table has a row.
CompiledScene scene_of_everything() {
    const auto picture = std::make_shared<ImageTexture>(std::make_shared<Image>(2, 3, Color{0.25, 0.5, 1}));
    const auto checker = std::make_shared<Checker>(1, Color{}, Color{1, 1, 1});
    const auto marble = std::make_shared<Lambertian>(std::make_shared<Marble>(2, 7));
    const auto metal = std::make_shared<Metal>(checker, 0.25);
    const auto glass = std::make_shared<Dielectric>(1.5);
    MeshData data = cube_mesh();
    data.material_slots.assign(data.triangles.size(), 0);
    data.material_slots[3] = 1;
    const auto mesh = std::make_shared<Mesh>(data, std::vector<MaterialPtr>{marble, lamp(3)});
    data.uvs.assign(data.vertices.size(), Float2{0.5f, 0.25f});
    const auto textured = std::make_shared<Mesh>(data, std::vector<MaterialPtr>{grey(0.5), metal});
    return compile_with(
        Background::gradient({0, 0, 0.5}, {1, 1, 1}),
        {mesh, textured, std::make_shared<Instance>(textured, Transform::translate({3, 0, 0})),
         std::make_shared<Instance>(mesh, Transform::translate({0, 3, 0}), Transform::translate({0, 4, 0})),
         std::make_shared<ConstantMedium>(sphere({5, 5, 5}, 1, nullptr), 1, Color{1, 1, 1}),
         sphere({0, 0, -3}, 1, std::make_shared<OrenNayar>(picture, 0.5)), quad({9, 0, 0}, {1, 0, 0}, {0, 1, 0}, metal),
         std::make_shared<Sphere>(Point3{0, 0, 6}, Point3{0, 1, 6}, 0.5, glass),
         std::make_shared<Disk>(Point3{0, 9, 0}, Vec3{0, -1, 0}, 1, lamp(2)),
         sphere({0, -3, 0}, 1, std::make_shared<RoughConductor>(Color{0.9, 0.5, 0.2}, Roughness{0.25, 0.5})),
         sphere({3, -3, 0}, 1, std::make_shared<RoughDielectric>(1.5, 0.25)),
         sphere({6, -3, 0}, 1, std::make_shared<Plastic>(Color{0.5, 0.25, 0.5}, 0.25)),
         std::make_shared<Triangle>(Point3{7, 0, 0}, Point3{8, 0, 0}, Point3{7, 1, 0}, grey(0.25))});
}

template <class Table>
std::string bytes_of(const Table& table) {
    return std::string(reinterpret_cast<const char*>(table.data()), table.size() * sizeof(table[0]));
}

void check_same(const CompiledScene& a, const CompiledScene& b) {
    std::vector<std::string> tables[2];
    for (const bool second : {false, true})
        flat::each_table((second ? b : a).flat(), [&](const auto& t) { tables[second].push_back(bytes_of(t)); });
    CHECK((tables[0] == tables[1]));
    CHECK(a.digest() == b.digest());
    CHECK(a.name() == b.name());
    CHECK(a.features() == b.features());
    CHECK(a.stats().stored_primitives == b.stats().stored_primitives);
    CHECK(a.stats().memory_bytes == b.stats().memory_bytes);
}

std::string fault_of(const std::string& path) {
    try {
        CompiledScene::load(path);
        return "none";
    } catch (const FileError& error) {
        const std::string message = error.what();
        REQUIRE(message.find(path + ": ") == 0);
        return message.substr(path.size() + 2);
    }
}

std::string content(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("Scene files: a scene that was read is the one that was written, and gives the same picture",
          "[compile][scene-file]") {
    const Folder folder;
    const std::string path = folder.path("a.scene");
    const CompiledScene scene = scene_of_everything();
    scene.save(path);
    const CompiledScene again = CompiledScene::load(path);
    check_same(scene, again);
    const Camera camera = camera_at({12, 8, 15}, {3, 2, 0}, 40);
    CHECK(render(scene, camera, square(32, 8, 8)).image == render(again, camera, square(32, 8, 8)).image);
    again.save(folder.path("b.scene"));
    CHECK(content(folder.path("b.scene")) == content(path));
}

TEST_CASE("Scene files: two of one scene, compiled once or twice, are the same bytes", "[compile][scene-file]") {
    const Folder folder;
    const auto bytes_of_scene = [&](const CompiledScene& scene) {
        scene.save(folder.path("same.scene"));
        return content(folder.path("same.scene"));
    };
    const CompiledScene scene = scene_of_everything();
    CHECK(bytes_of_scene(scene) == bytes_of_scene(scene));
    CHECK(bytes_of_scene(scene) == bytes_of_scene(scene_of_everything()));
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        CAPTURE(seed);
        const auto zoo = [&] {
            Random random(seed);
            std::vector<Object> objects{random_instance(random, random_shape(random, seed % 5))};
            for (std::size_t i = 0; i < seed % 10; ++i) objects.push_back(random_object(random, 2));
            return compile(zoo_of("zoo", objects).scene);
        };
        if (zoo().features().find("foreign") == std::string::npos)
            CHECK(bytes_of_scene(zoo()) == bytes_of_scene(zoo()));
    }
}

#if defined(__has_builtin) && __has_builtin(__builtin_clear_padding)
// Padding keeps whatever memory held: see flat/tables.h.
TEST_CASE("Scene files: what is written as it lies in memory has no padding", "[compile][scene-file]") {
    const auto has_none = []<class T>(std::type_identity<T>) {
        alignas(T) std::array<unsigned char, sizeof(T)> bytes;
        bytes.fill(0xff);
        T& value = *std::launder(reinterpret_cast<T*>(bytes.data()));
        __builtin_clear_padding(&value);
        return std::ranges::count(bytes, 0xff) == sizeof(T);
    };
    int number = 0;
    const flat::Scene scene;
    flat::each_table(scene, [&]<class Table>(const Table&) {
        CAPTURE(number++);
        CHECK(has_none(std::type_identity<typename Table::value_type>()));
    });
    flat::each_value(scene, [&]<class T>(const T&) {
        CAPTURE(number++);
        CHECK(has_none(std::type_identity<T>()));
    });
}
#endif

TEST_CASE("Scene files: lights that are no shapes, and the environment", "[compile][scene-file]") {
    const Folder folder;
    Scene described;
    auto map = std::make_shared<Image>(4, 2, Color{0.25, 0.5, 1});
    map->set(1, 0, {50, 40, 30});
    described.environment = std::make_shared<EnvironmentMap>(map);
    described.add(PointLight{.position = {0, 5, 0}, .intensity = {10, 10, 10}});
    described.add(floor_of(grey(0.5)));
    Model model;
    MeshData data = cube_mesh();
    data.material_slots.assign(data.triangles.size(), 1);
    model.meshes = {std::make_shared<Mesh>(data, std::vector<MaterialPtr>{grey(0.5), grey(0.25)})};
    model.instances = {{.mesh = 0}, {.mesh = 0, .world_from_mesh = Transform::translate({3, 0, 0})}};
    model.materials = {"clay"};
    described.add(model);
    const CompiledScene scene = compile(described);
    scene.save(folder.path("a.scene"));
    const CompiledScene again = CompiledScene::load(folder.path("a.scene"));
    check_same(scene, again);
    const auto hit = again.closest_hit({{0.5, 0.5, 9}, {0, 0, -1}});
    REQUIRE(hit);
    CHECK(again.material_name(*hit) == "clay");
    const Camera camera = camera_at({0, 8, 15}, {0, 0, 0}, 40);
    CHECK(render(scene, camera, square(16, 8, 4)).image == render(again, camera, square(16, 8, 4)).image);
}

TEST_CASE("Scene files: each material under each light, bit for bit", "[compile][scene-file]") {
    const Folder folder;
    const auto picture = std::make_shared<ImageTexture>(std::make_shared<Image>(2, 3, Color{0.25, 0.5, 0.75}));
    const auto checker = std::make_shared<Checker>(0.25, Color{}, Color{1, 1, 1});
    Image holes(2, 1, Color{0.25, 0.25, 0.25});
    holes.set(1, 0, {0.75, 0.75, 0.75});
    const auto mask = std::make_shared<ImageTexture>(holes);
    const Color copper{0.95, 0.6, 0.5};
    const auto metal = std::make_shared<RoughConductor>(copper, Roughness{0.1, 0.4}, Color{0.2, 0.3, 0.4});
    const auto varnish = std::make_shared<Plastic>(picture, 0.3, 1.4, checker);
    const std::vector<MaterialPtr> materials{
        metal,
        varnish,
        std::make_shared<RoughConductor>(picture, 0.3),
        std::make_shared<RoughConductor>(ComplexIndex{.eta = {0.2, 0.9, 1.1}, .k = {3.9, 2.4, 2.2}}, 0.3),
        std::make_shared<RoughDielectric>(1.5, Roughness{0.2, 0.4}),
        std::make_shared<Plastic>(Color{0.5, 0.25, 0.5}, 0.1),
        std::make_shared<MetallicRoughness>(picture, 0.5, 0.3),
        std::make_shared<MetallicRoughness>(picture, picture, 0.5, 0.7, 1.3),
        std::make_shared<NormalMap>(metal, picture),
        std::make_shared<NormalMap>(grey(0.5), picture),
        std::make_shared<AlphaMask>(varnish, mask),
        std::make_shared<AlphaMask>(varnish, mask, 0.5),
        std::make_shared<AlphaMask>(std::make_shared<NormalMap>(metal, picture), 0.5),
        std::make_shared<DiffuseLight>(picture, Sides::front),
        std::make_shared<DiffuseLight>(picture, Sides::back)};
    Image map(4, 2, Color{0.25, 0.5, 1});
    map.set(1, 0, {20, 10, 5});
    const auto environment = std::make_shared<EnvironmentMap>(map, Transform::rotate_y(30), 0.5);
    const Camera camera = camera_at({0, 0, 4}, {0, 0, 0}, 40);
    std::vector<Image> pictures;
    for (const MaterialPtr& material : materials) {
        Scene described;
        described.environment = environment;
        described.add(PointLight{.position = {0, 5, 0}, .intensity = {9, 9, 9}});
        described.add(SpotLight{.position = {3, 0, 3}, .direction = {-1, 0, -1}, .intensity = {5, 0, 0}});
        described.add(DirectionalLight{.direction = {1, -1, -1}, .irradiance = {0, 1, 0}});
        described.add(SunLight{.direction = {-1, -1, -1}, .irradiance = {0, 0, 2}, .angular_radius = 2});
        described.add(sphere({0, 0, 0}, 1, material));
        const CompiledScene scene = compile(described);
        scene.save(folder.path("a.scene"));
        const CompiledScene again = CompiledScene::load(folder.path("a.scene"));
        CAPTURE(pictures.size());
        check_same(scene, again);
        pictures.push_back(render(scene, camera, square(16, 8, 4)).image);
        CHECK(pictures.back() == render(again, camera, square(16, 8, 4)).image);
        const FirstHits seen = first_hits(scene, camera, square(16, 1, 1)),
                        seen_again = first_hits(again, camera, square(16, 1, 1));
        CHECK(seen.albedo == seen_again.albedo);
        CHECK(seen.normal == seen_again.normal);
        CHECK(seen.depth == seen_again.depth);
        // So each of them is seen, and what makes it another one.
        for (std::size_t i = 0; i + 1 < pictures.size(); ++i) CHECK_FALSE(pictures[i] == pictures.back());
    }
}

TEST_CASE("Scene files: random scenes answer as before, and can be moved", "[compile][scene-file]") {
    const Folder folder;
    int judged = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        Random random(seed);
        std::vector<Object> objects{random_instance(random, random_shape(random, seed % 5))};
        for (std::size_t i = 0; i < seed % 10; ++i) objects.push_back(random_object(random, 2));
        ZooScene zoo = zoo_of("zoo", objects);
        CompiledScene scene = compile(zoo.scene);
        if (scene.features().find("foreign") != std::string::npos) continue;
        ++judged;
        scene.save(folder.path("zoo.scene"));
        CompiledScene again = CompiledScene::load(folder.path("zoo.scene"));
        check_same(scene, again);
        const std::vector<MovedObject> moved{{0, random_pose(random)}};
        scene = recompile(std::move(scene), moved), again = recompile(std::move(again), moved);
        check_same(scene, again);
        for (int i = 0; i < 100; ++i) {
            const Ray ray = random_ray(random, zoo.targets);
            const auto a = scene.closest_hit(ray), b = again.closest_hit(ray);
            REQUIRE(a.has_value() == b.has_value());
            if (a) CHECK((a->t == b->t && a->primitive == b->primitive));
        }
    }
    CHECK(judged > 5);
}

TEST_CASE("Scene files: damaged at any byte, or cut short anywhere, they are refused", "[compile][scene-file]") {
    const Folder folder;
    const std::string path = folder.path("a.scene");
    scene_of_everything().save(path);
    const std::string bytes = content(path);
    Random random(1);
    // In place, which is sooner done than writing it anew.
    const auto put = [&](std::size_t place, char byte) {
        std::fstream(path, std::ios::in | std::ios::out | std::ios::binary)
            .seekp(static_cast<std::streamoff>(place))
            .put(byte);
    };
    for (std::size_t place = 0; place < bytes.size(); ++place) {
        put(place, static_cast<char>(bytes[place] ^ 1 << random.index(8)));
        const std::string fault = fault_of(path);
        put(place, bytes[place]);
        CAPTURE(place);
        if (place < 8)
            REQUIRE(fault == "is not a compiled scene");
        else if (place < 12)
            REQUIRE(fault.find("is a compiled scene of format ") == 0);
        else if (place < 16)
            REQUIRE(fault == "is a compiled scene of another version of limn");
        else
            REQUIRE((fault.find("is damaged: ") == 0 || fault == "is cut short"));
    }
    for (std::size_t length = 0; length < bytes.size(); length += 1 + random.index(200)) {
        CAPTURE(length);
        REQUIRE(fault_of(folder.write("cut.scene", bytes.substr(0, length))) ==
                (length == 0 ? "is not a compiled scene" : "is cut short"));
    }
    CHECK(fault_of(folder.write("long.scene", bytes + "x")) == "is damaged: its end");
    CHECK_THROWS_AS(CompiledScene::load(folder.path("none")), FileError);
    CHECK_THROWS_AS(CompiledScene::load(folder.path()), FileError);
}

TEST_CASE("Scene files: user-defined objects are refused by their kind, and nothing is written",
          "[compile][scene-file]") {
    struct OwnTexture final : Texture {
        Color value(const Surface&) const override { return {}; }
    };
    struct OwnMaterial final : Material {
        std::optional<ScatterSample> sample(const Surface&, const Vec3&, const Random3&) const override { return {}; }
        ScatterValue value(const Surface&, const Vec3&, const Vec3&) const override { return {}; }
    };
    const Folder folder;
    const auto refused = [&](const Object& object, const std::string& what) {
        CHECK_THROWS_WITH(compile_with(sky(1), {object}).save(folder.path("own.scene")),
                          "CompiledScene::save: the scene has user-defined " + what);
        CHECK_FALSE(std::filesystem::exists(folder.path("own.scene")));
    };
    refused(std::make_shared<Stranger>(ball({0, 0, 0}, 1)), "shapes");
    refused(sphere({0, 0, 0}, 1, std::make_shared<OwnMaterial>()), "materials");
    refused(sphere({0, 0, 0}, 1, std::make_shared<Lambertian>(std::make_shared<OwnTexture>())), "textures");
    CHECK_THROWS_AS(scene_of_everything().save(folder.path("none/a.scene")), FileError);
}

}  // namespace limn::scene_file_test
