// RecordSink: what is written down, in which rows, under which numbers.
#include "catch.h"
#include "limn/math/error.h"
#include "limn/records/record_sink.h"
#include "support/meshes.h"

namespace limn::records_test {

namespace {

const SphereRecord kBall{{0, 0, 0}, {0, 0, 0}, 1, MaterialId::none}, kMoving{{0, 0, 0}, {0, 0, 1}, 1, MaterialId::none};

std::shared_ptr<const void> something() { return std::make_shared<int>(0); }

MeshRecord record_of(const MeshData& data) { return {{data.vertices, data.triangles, {}, {}, {}}, {}}; }

TextureRecord scaled(double scale, TextureId even = TextureId::none) {
    TextureRecord record;
    record.scale = scale, record.even = even;
    return record;
}

bool same(const PrimitiveRange& a, const PrimitiveRange& b) {
    return a.kind == b.kind && a.first_row == b.first_row && a.first_number == b.first_number && a.count == b.count;
}

}  // namespace

TEST_CASE("RecordSink: shapes of one kind in a row share a range, another kind opens the next", "[compile][records]") {
    RecordSink sink;
    for (int i = 0; i < 3; ++i) sink.triangle({});
    for (int i = 0; i < 2; ++i) sink.quad({});
    sink.triangle({});
    for (int i = 0; i < 2; ++i) sink.user_defined({});
    CHECK(sink.primitives() == 8);
    const SceneRecords& records = sink.records();
    CHECK((records.triangles.size() == 4 && records.quads.size() == 2 && records.user_defined.size() == 2));
    const PrimitiveRange expected[] = {{PrimitiveKind::triangle, 0, 0, 3},
                                       {PrimitiveKind::quad, 0, 3, 2},
                                       {PrimitiveKind::triangle, 3, 5, 1},
                                       {PrimitiveKind::user_defined, 0, 6, 2}};
    const auto& ranges = records.blases.at(0).ranges;
    REQUIRE(ranges.size() == 4);
    for (std::size_t i = 0; i < 4; ++i) CHECK(same(ranges[i], expected[i]));
}

TEST_CASE("RecordSink: still and moving spheres stand in one table, in ranges of their own", "[compile][records]") {
    RecordSink sink;
    for (const SphereRecord& s : {kBall, kMoving, kMoving, kBall}) sink.sphere(s);
    const auto& ranges = sink.records().blases.at(0).ranges;
    CHECK(sink.records().spheres.size() == 4);
    REQUIRE(ranges.size() == 3);
    CHECK(same(ranges[0], {PrimitiveKind::sphere, 0, 0, 1}));
    CHECK(same(ranges[1], {PrimitiveKind::moving_sphere, 1, 1, 2}));
    CHECK(same(ranges[2], {PrimitiveKind::sphere, 3, 3, 1}));
}

TEST_CASE("RecordSink: a mesh, an instance or a medium is a row of its own, with all of its primitives",
          "[compile][records]") {
    RecordSink sink;
    const MeshData cube = test::cube_mesh();
    const auto owner = something();
    sink.mesh(record_of(cube), owner);
    sink.mesh(record_of(cube), owner);
    const BlasId blas = sink.blas(something(), [](RecordSink& inner) {
        inner.sphere(kBall);
        inner.quad({});
        CHECK(inner.primitives() == 2);
    });
    sink.instance({{}, {}, blas, false});
    sink.instance({{}, {}, blas, false});
    sink.medium({blas, MaterialId::none, 1});
    sink.medium({blas, MaterialId::none, 1});
    const auto& ranges = sink.records().blases.at(0).ranges;
    const PrimitiveRange expected[] = {{PrimitiveKind::mesh, 0, 0, 12},     {PrimitiveKind::mesh, 1, 12, 12},
                                       {PrimitiveKind::instance, 0, 24, 2}, {PrimitiveKind::instance, 1, 26, 2},
                                       {PrimitiveKind::medium, 0, 28, 2},   {PrimitiveKind::medium, 1, 30, 2}};
    REQUIRE(ranges.size() == 6);
    for (std::size_t i = 0; i < 6; ++i) CHECK(same(ranges[i], expected[i]));
    CHECK(sink.primitives() == 32);
}

TEST_CASE("RecordSink: a shared BLAS, material, texture, image or lattice is written once", "[compile][records]") {
    RecordSink sink;
    int described = 0;
    const auto a = something(), b = something();
    const auto fill = [&](RecordSink& inner) { ++described, inner.quad({}); };
    const BlasId first = sink.blas(a, fill), second = sink.blas(b, fill);
    CHECK((first == BlasId{1} && second == BlasId{2}));
    CHECK((sink.blas(a, fill) == first && described == 2));
    CHECK(sink.primitives() == 0);  // they are of their BLASes, not of the scene
    const auto material = [&] { return ++described, MaterialRecord{.opacity_cutoff = 7}; };
    const auto texture = [&] { return ++described, scaled(9); };
    described = 0;
    CHECK((sink.material(a, material) == MaterialId{0} && sink.material(b, material) == MaterialId{1}));
    CHECK((sink.material(a, material) == MaterialId{0} && described == 2));
    CHECK((sink.texture(a, texture) == TextureId{0} && sink.texture(b, texture) == TextureId{1}));
    CHECK((sink.texture(a, texture) == TextureId{0} && described == 4));
    CHECK((sink.material(nullptr, material) == MaterialId::none && sink.texture(nullptr, texture) == TextureId::none));
    CHECK(described == 4);
    CHECK((sink.records().materials.size() == 2 && sink.records().materials[1].opacity_cutoff == 7));
    CHECK((sink.records().textures.size() == 2 && sink.records().textures[1].scale == 9));
    const auto image = std::make_shared<Image>(1, 1), other = std::make_shared<Image>(2, 1);
    CHECK((sink.image(image) == 0 && sink.image(other) == 1 && sink.image(image) == 0));
    CHECK(sink.records().images.size() == 2);
    const auto lattice = std::make_shared<PerlinLattice>(), coarse = std::make_shared<PerlinLattice>();
    CHECK((sink.lattice(lattice) == 0 && sink.lattice(coarse) == 1 && sink.lattice(lattice) == 0));
    CHECK(sink.records().lattices.size() == 2);
}

TEST_CASE("RecordSink: a material that describes others in the middle of its own description keeps its row",
          "[compile][records]") {
    RecordSink sink;
    const auto outer = something(), inner = something();
    const TextureId id = sink.texture(outer, [&] { return scaled(3, sink.texture(inner, [] { return scaled(2); })); });
    const auto& textures = sink.records().textures;
    CHECK(textures.at(static_cast<std::size_t>(id)).scale == 3);
    CHECK(textures.at(static_cast<std::size_t>(textures[static_cast<std::size_t>(id)].even)).scale == 2);
}

TEST_CASE("RecordSink: what records point to lives as long as they do", "[compile][records]") {
    std::weak_ptr<const void> seen[4];
    auto records = std::make_unique<SceneRecords>();
    {
        std::shared_ptr<const void> owners[4];
        for (std::size_t i = 0; i < 4; ++i) seen[i] = owners[i] = something();
        RecordSink sink;
        sink.material(owners[0], [] { return MaterialRecord{}; });
        sink.texture(owners[1], [] { return TextureRecord{}; });
        sink.mesh({}, owners[2]);
        sink.blas(owners[3], [](RecordSink&) {});
        *records = std::move(sink).take();
    }
    for (const auto& object : seen) CHECK_FALSE(object.expired());
    records.reset();
    for (const auto& object : seen) CHECK(object.expired());
}

TEST_CASE("RecordSink: a BLAS inside itself is refused, beside itself not", "[compile][records]") {
    RecordSink sink;
    const auto a = something(), b = something();
    CHECK_THROWS_AS(sink.blas(a, [&](RecordSink& inner) { inner.blas(a, [](RecordSink&) {}); }), ArgumentError);
    RecordSink other;
    const BlasId shared = other.blas(b, [](RecordSink& inner) { inner.quad({}); });
    other.blas(a, [&](RecordSink& inner) {
        inner.instance({{}, {}, inner.blas(b, [](RecordSink&) {}), false});
        inner.instance({{}, {}, shared, false});
    });
    other.quad({});  // of the scene again
    CHECK(other.primitives() == 1);
    CHECK(other.records().blases.at(2).primitives == 2);
}

TEST_CASE("RecordSink: an object may be entered again once it is left, not before", "[compile][records]") {
    RecordSink sink;
    const int a = 0, b = 0;
    sink.enter(&a);
    CHECK_NOTHROW(sink.enter(&b));
    CHECK_THROWS_AS(sink.enter(&a), ArgumentError);
    sink.leave(&a);
    CHECK_NOTHROW(sink.enter(&a));
    CHECK_THROWS_AS(sink.enter(&b), ArgumentError);
}

TEST_CASE("RecordSink: more primitives than numbers are refused", "[compile][records]") {
    RecordSink sink;
    BlasId id = sink.blas(something(), [](RecordSink& inner) {
        for (int i = 0; i < 1024; ++i) inner.quad({});
    });
    const auto deeper = [&](int copies) {
        id = sink.blas(something(), [&](RecordSink& inner) {
            for (int i = 0; i < copies; ++i) inner.instance({{}, {}, id, false});
        });
    };
    for (int level = 0; level < 5; ++level) deeper(1024);  // 2^60
    CHECK_NOTHROW(deeper(7));                              // below 2^63
    CHECK_THROWS_AS(deeper(2), ArgumentError);
}

}  // namespace limn::records_test
