// The flat tables: trees that hold all that is under them, numbers that lead to a place, and what is counted.
#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "catch.h"
#include "flat/compile.h"
#include "limn/math/error.h"
#include "limn/query/compiled_scene.h"
#include "limn/scene/material/diffuse_light.h"
#include "limn/scene/texture/checker.h"
#include "limn/scene/texture/image_texture.h"
#include "support/scene_zoo.h"

namespace limn::tables_test {

using namespace test;

namespace {

using Seen = std::map<std::pair<std::uint32_t, std::uint32_t>, int>;  // range and element

void visit_leaf(const flat::Scene& scene, const flat::Blas& blas, flat::Child leaf, Seen& seen) {
    const flat::Form form = flat::form_of(leaf);
    REQUIRE((leaf & flat::kPlaceMask) + flat::lines_of(form) <= scene.lines.size());
    const flat::BlockView block(&scene.lines[leaf & flat::kPlaceMask]);
    const std::size_t count = block.count(form);
    REQUIRE((count > 0 && count <= flat::kMaxBlock));
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t id = block.id(form, i);
        if ((id & flat::kReference) == 0) {
            const auto ranges = flat::ranges_of(scene, blas);
            const auto after = std::ranges::upper_bound(ranges, std::uint64_t{id}, {}, &PrimitiveRange::first_number);
            const auto range = static_cast<std::uint32_t>(after - ranges.begin() - 1);
            CHECK(ranges[range].kind == PrimitiveKind::mesh);
            ++seen[{blas.first_range + range, id - static_cast<std::uint32_t>(ranges[range].first_number)}];
        } else {
            const flat::Reference& r = scene.references.at(id & ~flat::kReference);
            const flat::Form own = flat::form_of(scene.ranges.at(r.range).kind);
            CHECK((own == form || (own == flat::Form::spheres && form == flat::Form::moving_spheres)));
            ++seen[{r.range, r.element}];
        }
    }
}

// Counts the primitives below a child; its box must hold the boxes of its own children.
void visit(const flat::Scene& scene, const flat::Blas& blas, flat::Child child, Seen& seen, int depth = 0) {
    REQUIRE(depth < 100);
    if (child == flat::kNothing) return;
    if ((child & flat::kLeaf) != 0) return visit_leaf(scene, blas, child, seen);
    const flat::Node& node = scene.nodes.at(child);
    for (std::size_t i = 0; i < flat::kWidth; ++i) {
        if (node.child[i] == flat::kNothing) {
            CHECK(node.planes[0][i] > node.planes[3][i]);
            continue;
        }
        if ((node.child[i] & flat::kLeaf) == 0) {
            const flat::Node& child_node = scene.nodes.at(node.child[i]);
            for (std::size_t k = 0; k < flat::kWidth && child_node.child[k] != flat::kNothing; ++k)
                for (std::size_t a = 0; a < 3; ++a) {
                    CHECK(child_node.planes[a][k] >= node.planes[a][i]);
                    CHECK(child_node.planes[3 + a][k] <= node.planes[3 + a][i]);
                }
        }
        visit(scene, blas, node.child[i], seen, depth + 1);
    }
}

// With each instance counted once.
std::size_t listed_beside_tree(const flat::Scene& scene) {
    if (scene.list.is_all) return 0;  // of small scenes, all of it stands in the tree as well
    std::size_t count = 0;
    std::set<std::uint32_t> instances;
    for (const flat::PrimitiveList::Entry& e : scene.list.entries)
        count += !e.is_instanced || instances.insert(e.instance).second ? 1 : 0;
    return count;
}

flat::Scene flatten(const std::vector<Object>& objects) { return compiler::flatten(zoo_of("tables", objects).scene); }

}  // namespace

TEST_CASE("Trees: each primitive of a BLAS stands in one leaf of its tree, under boxes that narrow",
          "[compile][tables]") {
    for (const ZooScene& zoo :
         {zoo_mixed(410), zoo_mixed(411), zoo_instances(), zoo_media(), zoo_mesh(), zoo_of_kind("spheres", 0, 200, 412),
          zoo_of("one", {ball({}, 1)}), zoo_of("none", {})}) {
        const flat::Scene scene = compiler::flatten(zoo.scene);
        std::size_t references = 0;
        for (const flat::Blas& blas : scene.blases) {
            Seen seen;
            visit(scene, blas, blas.root, seen);
            for (const auto& [place, times] : seen) {
                CHECK(times == 1);
                CHECK((place.first >= blas.first_range && place.first < blas.first_range + blas.range_count));
            }
            std::size_t expected = 0;
            for (std::uint32_t i = 0; i < blas.range_count; ++i) {
                const PrimitiveRange& range = scene.ranges[blas.first_range + i];
                if (range.kind == PrimitiveKind::instance)  // of a BLAS that holds nothing but media: none
                    expected += !flat::blas_at(scene, scene.instances[range.first_row].blas).bounds.is_empty();
                else if (range.kind != PrimitiveKind::medium)
                    expected += range.count;
            }
            references += seen.size();
            const std::size_t listed = &blas == &scene.blases.front() ? listed_beside_tree(scene) : 0;
            if (scene.degenerate == 0) CHECK(seen.size() + listed == expected);
        }
        std::size_t of_meshes = 0;
        for (const PrimitiveRange& range : scene.ranges)
            if (range.kind == PrimitiveKind::mesh) of_meshes += range.count;
        if (scene.degenerate == 0) CHECK(references == scene.references.size() + of_meshes);
    }
}

TEST_CASE("Trees: in a node the boxes are those of the shapes, rounded outward to float by less than an ulp",
          "[compile][tables]") {
    for (const double x : {0.1, -0.1, 1e30, -1e-30, 0.5}) {
        const auto triangle =
            std::make_shared<Triangle>(Point3{x, 0.5, 0.5}, Point3{x + std::abs(x), 1, 0.75}, Point3{x, 1, 1}, nullptr);
        const flat::Scene scene = flatten(std::vector<Object>(flat::kMaxBlock + 1, triangle));
        const flat::Node& node = scene.nodes.at(scene.blases.at(0).root);
        const double lower = x, upper = x + std::abs(x), scale = scene.blases[0].scale;
        const float inf = std::numeric_limits<float>::infinity();
        CHECK((node.planes[0][0] <= scale * lower && std::nextafter(node.planes[0][0], inf) > scale * lower));
        CHECK((node.planes[3][0] >= scale * upper && std::nextafter(node.planes[3][0], -inf) < scale * upper));
        CHECK(scene.blases[0].bounds == Box{{lower, 0.5, 0.5}, {upper, 1, 1}});
        CHECK(scene.blases[0].extent == std::max(1.0, std::max(std::abs(lower), std::abs(upper))));
    }
}

TEST_CASE("locate: each number leads to its range, element and instances, outermost first", "[compile][tables]") {
    const Object mesh = std::make_shared<Mesh>(cube_mesh(), nullptr);
    const Object quad = std::make_shared<Quad>(Point3{}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, nullptr);
    const Object blas =
        std::make_shared<HittableList>(std::vector<Object>{quad, mesh, ball({}, 1), ball({9, 0, 0}, 2)});
    const Object inner = std::make_shared<Instance>(blas, Transform::translate({1, 0, 0}));
    const Object pair = std::make_shared<HittableList>(std::vector<Object>{ball({}, 3), inner, inner});
    const Object outer = std::make_shared<Instance>(pair, Transform::translate({2, 0, 0}));
    const flat::Scene scene = flatten({quad, outer, std::make_shared<ConstantMedium>(inner, 1, Color{}), ball({}, 4)});
    const auto at = [&](std::uint64_t number) { return flat::locate(scene, number); };
    const auto kind = [&](std::uint64_t number) { return scene.ranges[at(number).range].kind; };
    CHECK(scene.primitives == 1 + (1 + 2 * 15) + 15 + 1);
    CHECK((kind(0) == PrimitiveKind::quad && at(0).depth == 0 && at(0).element == 0));
    CHECK((kind(1) == PrimitiveKind::sphere && at(1).depth == 1));
    for (const std::uint64_t first : {2u, 17u}) {  // the two inner copies
        CHECK((kind(first) == PrimitiveKind::quad && at(first).element == 0));
        for (std::uint64_t i = 0; i < 12; ++i)
            CHECK((kind(first + 1 + i) == PrimitiveKind::mesh && at(first + 1 + i).element == i));
        for (std::uint64_t i = 0; i < 2; ++i)
            CHECK((kind(first + 13 + i) == PrimitiveKind::sphere && at(first + 13 + i).element == i));
        CHECK((at(first).depth == 2 && !at(first).index_matched));
        CHECK(scene.instances[at(first).instances[0]].world_from_object0 == Transform::translate({2, 0, 0}));
        CHECK(scene.instances[at(first).instances[1]].world_from_object0 == Transform::translate({1, 0, 0}));
    }
    CHECK(at(2).instances[1] != at(17).instances[1]);
    CHECK(at(2).instances[0] == at(17).instances[0]);
    CHECK((kind(32) == PrimitiveKind::quad && at(32).index_matched && at(32).depth == 1));
    CHECK((kind(46) == PrimitiveKind::sphere && at(46).index_matched && at(46).element == 1));
    CHECK((kind(47) == PrimitiveKind::sphere && !at(47).index_matched && at(47).depth == 0));
    const auto& spheres = std::get<std::vector<primitives::Sphere>>(scene.rows);
    CHECK(spheres[scene.ranges[at(47).range].first_row + at(47).element].radius == 4);
    CHECK(spheres[scene.ranges[at(46).range].first_row + at(46).element].radius == 2);
}

TEST_CASE("material_of: each kind of shape knows its own, and shapes without one are counted where they are seen",
          "[compile][tables]") {
    const auto grey = std::make_shared<Lambertian>(Color{0.5, 0.5, 0.5}),
               red = std::make_shared<Lambertian>(Color{1, 0, 0});
    MeshData data = cube_mesh();
    for (std::uint32_t i = 0; i < 12; ++i) data.material_slots.push_back(i == 7 ? 1 : 0);
    const auto shapes = [&](const std::shared_ptr<const Material>& m) {
        return std::vector<Object>{std::make_shared<Sphere>(Point3{}, 1.0, m),
                                   std::make_shared<Sphere>(Point3{}, Point3{1, 0, 0}, 1.0, m),
                                   std::make_shared<Triangle>(Point3{}, Point3{1, 0, 0}, Point3{0, 1, 0}, m),
                                   std::make_shared<Quad>(Point3{}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, m),
                                   std::make_shared<Mesh>(data, std::vector<std::shared_ptr<const Material>>{m, red})};
    };
    std::vector<Object> objects = shapes(grey);
    const flat::Scene scene = flatten(objects);
    const auto of = [&](std::uint64_t number) {
        const flat::Place place = flat::locate(scene, number);
        return flat::material_of(scene, scene.ranges[place.range], place.element);
    };
    for (std::uint64_t number = 0; number < 16; ++number) CHECK((of(number) == of(0)) == (number != 4 + 7));
    CHECK(of(11) != MaterialId::none);
    CHECK(scene.unassigned == 0);
    CHECK(scene.materials.size() == 2);
    const flat::Scene slotless =
        flatten({std::make_shared<Mesh>(cube_mesh(), std::vector<std::shared_ptr<const Material>>{nullptr, red})});
    CHECK(slotless.unassigned == 12);  // all have the first

    const auto bare = [](const std::vector<Object>& seen) { return flatten(seen).unassigned; };
    for (std::size_t i = 0; i < 5; ++i) CHECK(bare({objects[i], shapes(nullptr)[i]}) == (i == 4 ? 11u : 1u));
    const Object list = std::make_shared<HittableList>(shapes(nullptr));
    const Object instance = std::make_shared<Instance>(list, Transform::translate({3, 0, 0}));
    CHECK(bare({instance, instance, list}) == 2 * 15);  // stored once for all instances, and once in the scene
    CHECK(bare({std::make_shared<ConstantMedium>(instance, 1, Color{})}) == 0);  // a boundary needs none
    CHECK(bare({std::make_shared<Stranger>(list)}) == 0);                        // tells its own with each hit
}

TEST_CASE("compile: every feature is named where it occurs, and only there", "[compile][tables]") {
    const auto grey = std::make_shared<Lambertian>(Color{0.5, 0.5, 0.5});
    const Object cube = std::make_shared<Mesh>(cube_mesh(), grey),
                 round = std::make_shared<Sphere>(Point3{}, 1.0, grey);
    const auto with = [](const std::shared_ptr<const Texture>& t) {
        return std::make_shared<Sphere>(Point3{}, 1.0, std::make_shared<Lambertian>(t));
    };
    class Spots final : public Texture {
    public:
        Color value(const Surface&) const override { return {}; }
    };
    class Wax final : public Material {
    public:
        std::optional<ScatterSample> sample(const Surface&, const Vec3&, const Random3&) const override { return {}; }
        ScatterValue value(const Surface&, const Vec3&, const Vec3&) const override { return {}; }
    };
    MeshData smooth = cube_mesh();
    smooth.normals.assign(8, {0, 0, 1});
    const auto features = [](const Object& object) { return flatten({object}).feature_names; };
    CHECK(features(round) == "sphere");
    CHECK(features(std::make_shared<Sphere>(Point3{}, Point3{1, 0, 0}, 1.0, grey)) == "moving-sphere");
    CHECK(features(std::make_shared<Triangle>(Point3{}, Point3{1, 0, 0}, Point3{0, 1, 0}, grey)) == "triangle");
    CHECK(features(std::make_shared<Quad>(Point3{}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, grey)) == "quad");
    CHECK(features(cube) == "mesh");
    CHECK(features(std::make_shared<Mesh>(smooth, grey)) == "mesh smooth-normals");
    CHECK(features(std::make_shared<Instance>(round, Transform{})) == "sphere instance");
    CHECK(features(std::make_shared<Instance>(round, Transform{}, Transform::translate({1, 0, 0}))) ==
          "sphere instance moving-instance");
    CHECK(features(std::make_shared<Stranger>(round)) == "foreign-shape");
    CHECK(features(std::make_shared<ConstantMedium>(round, 1, Color{1, 1, 1})) == "sphere medium");
    CHECK(features(std::make_shared<Sphere>(Point3{}, 1.0, std::make_shared<DiffuseLight>(Color{1, 0, 0}))) ==
          "sphere light");
    // One among others is enough, the first or the last.
    const Object checked = with(std::make_shared<Checker>(1, Color{}, Color{1, 1, 1})),
                 spotted = with(std::make_shared<Spots>()),
                 wax = std::make_shared<Sphere>(Point3{}, 1.0, std::make_shared<Wax>()),
                 painted = with(std::make_shared<ImageTexture>(Image(1, 1))),
                 moving = std::make_shared<Instance>(round, Transform{}, Transform::translate({1, 0, 0})),
                 still = std::make_shared<Instance>(round, Transform{});
    const auto either_way = [](const Object& a, const Object& b) {
        const std::string names = flatten({a, b}).feature_names;
        CHECK(flatten({b, a}).feature_names == names);
        return names;
    };
    CHECK(either_way(std::make_shared<Mesh>(smooth, grey), cube) == "mesh smooth-normals");
    CHECK(either_way(moving, still) == "sphere instance moving-instance");
    CHECK(either_way(checked, round) == "sphere texture");
    CHECK(either_way(spotted, round) == "sphere texture foreign-texture");
    CHECK(either_way(wax, round) == "sphere foreign-material");
    CHECK((flatten({painted, round}).features.texture_coordinates &&
           flatten({round, painted}).features.texture_coordinates));
    for (const Background& sky : {Background::gradient({0, 0, 1}, {}), Background::gradient({}, {0, 1, 0})}) {
        Scene scene;
        scene.background = sky;
        CHECK(compiler::flatten(scene).feature_names == "background");
        CHECK(compiler::flatten(scene).background_bottom == sky.bottom);
        CHECK(compiler::flatten(scene).background_top == sky.top);
    }
    // Coordinates are worked out only where something may ask for them.
    const auto asks = [](const Object& object) { return flatten({object}).features.texture_coordinates; };
    for (const Object& object : {painted, spotted, wax, Object(std::make_shared<Stranger>(round))}) CHECK(asks(object));
    CHECK_FALSE(asks(checked));
    CHECK_FALSE(asks(round));
}

TEST_CASE("compile: instances nest sixteen deep, not seventeen, and what they hold may be shared",
          "[compile][tables]") {
    const auto nested = [](int depth, Object object) {
        for (int i = 0; i < depth; ++i) object = std::make_shared<Instance>(object, Transform::translate({1, 0, 0}));
        return object;
    };
    const flat::Scene deep = flatten({nested(16, ball({}, 1))});
    CHECK(flat::locate(deep, 0).depth == 16);
    const CompiledScene compiled = compile(zoo_of("deep", {nested(16, ball({}, 1))}).scene);
    CHECK(compiled.closest_hit({.origin = {16, 0, 5}, .direction = {0, 0, -1}})->t == 4);
    CHECK_THROWS_AS(flatten({nested(17, ball({}, 1))}), Error);
    CHECK_THROWS_AS(flatten({ball({}, 1), nested(10, nested(7, ball({}, 1)))}), Error);
    // A boundary's own instances count as well.
    const auto fog = [](const Object& boundary) { return std::make_shared<ConstantMedium>(boundary, 1, Color{}); };
    CHECK_NOTHROW(flatten({nested(8, fog(nested(8, ball({}, 1))))}));
    CHECK_THROWS_AS(flatten({nested(8, fog(nested(9, ball({}, 1))))}), Error);
}

TEST_CASE("CompiledScene: of shapes in a row only the first on the way is asked", "[compile][tables]") {
    class Counted final : public Hittable {
    public:
        explicit Counted(double x) : sphere_({x, 0, 0}, 0.5, nullptr) {}
        Box bounds() const override { return sphere_.bounds(); }
        std::optional<Hit> hit(const Ray& ray) const override {
            ++asked;
            return sphere_.hit(ray);
        }
        mutable int asked = 0;

    private:
        Sphere sphere_;
    };
    std::vector<std::shared_ptr<Counted>> row;
    for (int i = 0; i < 64; ++i) row.push_back(std::make_shared<Counted>(2.0 * i));
    const std::vector<Object> objects(row.begin(), row.end());
    const CompiledScene compiled = compile(zoo_of("row", objects).scene);
    const Bvh bvh(objects);
    for (const double way : {1.0, -1.0})
        for (const std::size_t from : {0u, 20u, 63u}) {
            const Ray ray{.origin = {2.0 * static_cast<double>(from) - way, 0, 0}, .direction = {way, 0, 0}};
            const auto asked_by = [&](const auto& query) {
                for (const auto& shape : row) shape->asked = 0;
                query();
                int others = 0;
                for (std::size_t i = 0; i < row.size(); ++i) others += i == from ? 0 : row[i]->asked;
                CHECK(others == 0);
                return row[from]->asked;
            };
            CHECK(asked_by([&] { CHECK(compiled.any_hit(ray)); }) == 1);
            CHECK(asked_by([&] { CHECK(compiled.closest_hit(ray)->t == 0.5); }) == 1);
            CHECK(asked_by([&] { CHECK(bvh.hit(ray)->t == 0.5); }) == 1);
        }
}

}  // namespace limn::tables_test
