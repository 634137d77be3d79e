#include "limn/scene/material/material.h"

#include <cmath>
#include <vector>

#include "catch.h"
#include "limn/math/error.h"
#include "limn/scene/material/dielectric.h"
#include "limn/scene/material/diffuse_light.h"
#include "limn/scene/material/isotropic.h"
#include "limn/scene/material/lambertian.h"
#include "limn/scene/material/metal.h"
#include "limn/scene/texture/solid.h"
#include "material/lobe.h"

namespace limn::material_test {

using namespace test;

namespace {

struct White {
    std::shared_ptr<const Material> material;
    bool lossless = true;
};

std::vector<White> white_materials() {
    const Color white{1, 1, 1};
    return {{std::make_shared<Lambertian>(white)},
            {std::make_shared<Isotropic>(white)},
            {std::make_shared<Metal>(white)},
            {std::make_shared<Metal>(white, .3), false},  // fuzz can lead below the surface
            {std::make_shared<Metal>(white, 1), false},
            {std::make_shared<Dielectric>(1.5)},
            {std::make_shared<Dielectric>(1.5, Fresnel::schlick)},
            {std::make_shared<Dielectric>(1 / 1.5)}};
}

// Answers with its arguments, so that a test sees that they arrive.
class Echo final : public Material {
public:
    Color emitted(const Surface& s) const override { return {s.uv.u, 0, 0}; }
    std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& r) const override {
        return ScatterSample{.direction = out, .weight = {s.uv.u, r.x, r.y}, .pdf = r.z};
    }
    ScatterValue value(const Surface& s, const Vec3& out, const Vec3& in) const override {
        return {.value = {s.uv.u, out.x, in.x}, .pdf = in.y};
    }
};

const MaterialRecord& record(const RecordSink& sink, MaterialId id) {
    return sink.records().materials.at(static_cast<std::size_t>(id));
}

void check_echo(const Material& object, const MaterialThunks& thunks) {
    Surface s;
    s.uv = {.25, 0};
    CHECK(thunks.emitted(object, s) == Color{.25, 0, 0});
    const auto sample = thunks.sample(object, s, {1, 0, 0}, {.1, .2, .3});
    REQUIRE(sample);
    CHECK(sample->direction == Vec3{1, 0, 0});
    CHECK(sample->weight == Color{.25, .1, .2});
    CHECK(sample->pdf == .3);
    const ScatterValue value = thunks.value(object, s, {.5, 0, 0}, {.6, .7, 0});
    CHECK(value.value == Color{.25, .5, .6});
    CHECK(value.pdf == .7);
}

}  // namespace

TEST_CASE("Material: in a white furnace the lossless return all, none returns more", "[material][furnace]") {
    for (const auto& [material, lossless] : white_materials())
        for (const double degrees : {0.0, 45.0, 80.0, 89.9})
            for (const bool front : {true, false}) {
                Surface s = surface({0, 0, 1});
                s.front_face = front;
                const Vec3 out{std::sin(radians(degrees)), 0, std::cos(radians(degrees))};
                std::mt19937_64 random(62);
                constexpr int kRays = 20'000;
                double sum = 0;
                for (int i = 0; i < kRays; ++i)
                    if (const auto sample = material->sample(s, out, random3(random))) sum += sample->weight.r;
                CAPTURE(degrees, front, sum);
                CHECK(sum <= kRays);
                CHECK(((sum == kRays) || !lossless));
            }
}

TEST_CASE("Material: directions are unit and finite in every corner of the random cube", "[material]") {
    const double corners[] = {0, 0x1p-1074, 0x1p-53, .25, .5, .75, kAlmostOne};
    std::vector<Vec3> outs{{0, 0, 1}, {1, 0, 0}, {0, -1, 0}, normalize({1, 0, 1e-8}), normalize({1, 1, 1e-300})};
    int violations = 0;
    for (const auto& [material, lossless] : white_materials())
        for (const Vec3& out : outs)
            for (const bool front : {true, false})
                for (const double x : corners)
                    for (const double y : corners)
                        for (const double z : corners) {
                            Surface s = surface({0, 0, 1});
                            s.front_face = front;
                            const auto sample = material->sample(s, out, {x, y, z});
                            if (sample &&
                                !(is_unit(sample->direction) && std::isfinite(sample->pdf) && sample->pdf >= 0))
                                ++violations;
                        }
    CHECK(violations == 0);
}

TEST_CASE("Material: no weight or value is negative or NaN, whatever the shading normal", "[material]") {
    std::mt19937_64 random(63);
    for (const auto& [material, lossless] : white_materials()) {
        int violations = 0;
        for (int i = 0; i < 100'000; ++i) {
            const Surface s = surface(random_direction(random), random_direction(random));
            const Vec3 out = random_out(random, s);
            const auto sample = material->sample(s, out, random3(random));
            if (sample && !(sample->weight.r >= 0 && sample->weight.r <= 1 && is_unit(sample->direction))) ++violations;
            const ScatterValue value = material->value(s, out, random_direction(random));
            if (!(value.value.r >= 0 && value.pdf >= 0 && std::isfinite(value.pdf))) ++violations;
        }
        CHECK(violations == 0);
    }
}

TEST_CASE("DiffuseLight: emits its texture on both sides and scatters nothing", "[material][light]") {
    const DiffuseLight lamp({4, 3, 2});
    for (const bool front : {true, false}) {
        Surface s = surface({0, 0, 1});
        s.front_face = front;
        CHECK(lamp.emitted(s) == Color{4, 3, 2});
        CHECK_FALSE(lamp.sample(s, {0, 0, 1}, {.5, .5, .5}));
        CHECK(is_black(lamp.value(s, {0, 0, 1}, {0, 0, 1}).value));
    }
    CHECK(is_black(Lambertian({1, 1, 1}).emitted(Surface{})));
}

TEST_CASE("DiffuseLight: impossible radiances are refused", "[material][light]") {
    for (const double bad : {-1.0, std::nan(""), kInfinity})
        CHECK_THROWS_AS(DiffuseLight(Color{0, bad, 0}), ArgumentError);
    CHECK_THROWS_AS(DiffuseLight(std::shared_ptr<const Texture>()), ArgumentError);
}

TEST_CASE("Material: a user's own is packed as a record that calls it", "[material][record]") {
    RecordSink sink;
    const auto mine = std::make_shared<Echo>();
    const MaterialRecord& packed = record(sink, lower_material(sink, mine));
    REQUIRE(packed.kind == kUserDefinedMaterial);
    REQUIRE(packed.object == mine.get());
    check_echo(*packed.object, *packed.thunks);
}

TEST_CASE("Material: a reference calls the described object, a null one nothing", "[material][record]") {
    const Echo mine;
    const MaterialRef reference = material_ref(&mine);
    REQUIRE(reference.id == MaterialRef::kObject);
    REQUIRE(reference.object == &mine);
    check_echo(*reference.object, *reference.thunks);
    CHECK(material_ref(nullptr).id == MaterialRef::kNone);
}

TEST_CASE("Material: records state what the built-in ones were made with", "[material][record]") {
    RecordSink sink;
    const auto texture = std::make_shared<SolidColor>(Color{.1, .2, .3});
    const auto pack = [&](std::shared_ptr<const Material> material) {
        return record(sink, lower_material(sink, material));
    };

    const MaterialRecord matte = pack(std::make_shared<Lambertian>(texture));
    CHECK(matte.kind == "lambertian");
    CHECK(sink.records().textures.at(static_cast<std::size_t>(matte.albedo)).color == Color{.1, .2, .3});

    const MaterialRecord metal = pack(std::make_shared<Metal>(texture, .3));
    CHECK(metal.kind == "metal");
    CHECK(metal.albedo == matte.albedo);
    CHECK(metal.parameters.as<Metal::Parameters>().fuzz == .3);

    const MaterialRecord glass = pack(std::make_shared<Dielectric>(1.5, Fresnel::schlick));
    CHECK(glass.kind == "dielectric");
    const auto glass_parameters = glass.parameters.as<Dielectric::Parameters>();
    CHECK(glass_parameters.index == 1.5);
    CHECK(glass_parameters.exact_fresnel == 0);
    CHECK(pack(std::make_shared<Dielectric>(1.5)).parameters.as<Dielectric::Parameters>().exact_fresnel == 1);
    CHECK(pack(std::make_shared<Metal>(texture)).parameters.as<Metal::Parameters>().fuzz ==
          0);  // unless told otherwise
    CHECK(pack(std::make_shared<Metal>(Color{.1, .2, .3})).parameters.as<Metal::Parameters>().fuzz == 0);

    const MaterialRecord lamp = pack(std::make_shared<DiffuseLight>(texture));
    CHECK(lamp.kind == "diffuse-light");
    CHECK(lamp.emission == matte.albedo);

    const MaterialRecord fog = pack(std::make_shared<Isotropic>(texture));
    CHECK(fog.kind == "isotropic");
    CHECK(fog.albedo == matte.albedo);
}

TEST_CASE("Material: one that is shared is packed once, and none for null", "[material][record]") {
    RecordSink sink;
    const auto glass = std::make_shared<Dielectric>(1.5);
    CHECK(lower_material(sink, glass) == lower_material(sink, glass));
    CHECK(sink.records().materials.size() == 1);
    CHECK(lower_material(sink, nullptr) == MaterialId::none);
}

}  // namespace limn::material_test
