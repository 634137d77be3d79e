#include "limn/scene/texture/texture.h"

#include <cmath>

#include "catch.h"
#include "limn/math/error.h"
#include "limn/math/math.h"
#include "limn/scene/texture/checker.h"
#include "limn/scene/texture/image_texture.h"
#include "limn/scene/texture/perlin.h"
#include "limn/scene/texture/solid.h"

namespace limn::texture_test {

namespace {

class Height final : public Texture {
public:
    Color value(const Surface& s) const override { return {s.position.y, s.uv.u, 0}; }
};

const TextureRecord& record(const RecordSink& sink, TextureId id) {
    return sink.records().textures.at(static_cast<std::size_t>(id));
}

}  // namespace

TEST_CASE("SolidColor: the same everywhere, and refuses what is no colour", "[texture]") {
    CHECK(SolidColor({.1, .2, 3}).value(Surface{}) == Color{.1, .2, 3});
    for (const double bad : {-0.1, std::nan(""), kInfinity}) {
        CHECK_THROWS_AS(SolidColor({bad, 0, 0}), ArgumentError);
        CHECK_THROWS_AS(SolidColor({0, bad, 0}), ArgumentError);
        CHECK_THROWS_AS(SolidColor({0, 0, bad}), ArgumentError);
    }
}

TEST_CASE("Texture: a user's own is packed as a record that calls it", "[texture][record]") {
    RecordSink sink;
    const auto mine = std::make_shared<Height>();
    const TextureRecord& packed = record(sink, lower_texture(sink, mine));
    REQUIRE(packed.kind == TextureKind::user_defined);
    REQUIRE(packed.object == mine.get());
    Surface s;
    s.position = {1, 2, 3};
    s.uv = {.25, .5};
    CHECK(packed.value(*packed.object, s) == Color{2, .25, 0});
}

TEST_CASE("Texture: one that is shared is packed once", "[texture][record]") {
    RecordSink sink;
    const auto solid = std::make_shared<SolidColor>(Color{1, 0, 0});
    const auto checker = std::make_shared<Checker>(2, solid, solid);
    const TextureId id = lower_texture(sink, checker);
    CHECK(lower_texture(sink, checker) == id);
    CHECK(sink.records().textures.size() == 2);
    CHECK(record(sink, id).even == record(sink, id).odd);
    CHECK(lower_texture(sink, nullptr) == TextureId::none);
}

TEST_CASE("Texture: records state what the built-in ones were made with", "[texture][record]") {
    RecordSink sink;
    const TextureRecord solid = record(sink, lower_texture(sink, std::make_shared<SolidColor>(Color{1, 2, 3})));
    CHECK(solid.kind == TextureKind::solid);
    CHECK(solid.color == Color{1, 2, 3});

    const TextureRecord checker =
        record(sink, lower_texture(sink, std::make_shared<Checker>(.32, Color{.2, .3, .1}, Color{.9, .9, .9})));
    CHECK(checker.kind == TextureKind::checker);
    CHECK(checker.scale == .32);
    CHECK(record(sink, checker.even).color == Color{.2, .3, .1});
    CHECK(record(sink, checker.odd).color == Color{.9, .9, .9});

    const auto image = std::make_shared<const Image>(2, 2, Color{1, 1, 1});
    const auto picture = std::make_shared<ImageTexture>(image, ImageTextureOptions{Filter::nearest, Wrap::mirror});
    const TextureRecord packed = record(sink, lower_texture(sink, picture));
    CHECK(packed.kind == TextureKind::image);
    CHECK(packed.filter == Filter::nearest);
    CHECK(packed.wrap == Wrap::mirror);
    CHECK(sink.records().images.at(packed.data) == image);
}

TEST_CASE("Texture: noises that share a lattice refer to the same one", "[texture][record]") {
    RecordSink sink;
    const auto lattice = std::make_shared<const PerlinLattice>(PerlinLattice::from_seed(1));
    const Color color{.5, .6, .7};
    const auto check = [&](const std::shared_ptr<const Texture>& texture, TextureKind kind) {
        const TextureRecord packed = record(sink, lower_texture(sink, texture));
        CHECK(packed.kind == kind);
        CHECK(packed.scale == 4);
        CHECK(packed.color == color);
        CHECK(sink.records().lattices.at(packed.data) == lattice);
    };
    check(std::make_shared<Noise>(4, lattice, color), TextureKind::noise);
    check(std::make_shared<Turbulence>(4, lattice, color), TextureKind::turbulence);
    check(std::make_shared<Marble>(4, lattice, color), TextureKind::marble);
    CHECK(sink.records().lattices.size() == 1);
}

}  // namespace limn::texture_test
