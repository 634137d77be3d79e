// Digests of scenes: other where a picture may be other, and nowhere else.
#include <functional>
#include <set>

#include "catch.h"
#include "limn/math/tagged.h"
#include "limn/query/compiled_scene.h"
#include "limn/scene/material/dielectric.h"
#include "limn/scene/material/isotropic.h"
#include "limn/scene/material/metal.h"
#include "limn/scene/material/plastic.h"
#include "limn/scene/material/rough_conductor.h"
#include "limn/scene/material/rough_dielectric.h"
#include "limn/scene/texture/checker.h"
#include "limn/scene/texture/image_texture.h"
#include "limn/scene/texture/perlin.h"
#include "support/pictures.h"

namespace limn::digest_test {

using namespace test;

namespace {

// Every number of a scene, to be changed one at a time.
struct Numbers {
    double background = 0.5, colour = 0.25, fuzz = 0.5, index = 1.5, density = 2, turn = 90, end = 1, radius = 1;
    double corner = 0, side = 1, apex = 2, frequency = 3, texel = 0.75;
    float vertex = 0.5f;
    std::uint32_t slot = 0, last = 3;
    std::uint64_t seed = 7;
    Fresnel fresnel = Fresnel::exact;
    Wrap wrap = Wrap::repeat;
    Filter filter = Filter::bilinear;
    bool second_ball = true, order = true;
};

Scene scene_of(const Numbers& n) {
    Scene scene;
    scene.background = Background::gradient({0, 0, n.background}, {1, 1, 1});
    const auto colour = std::make_shared<Lambertian>(Color{n.colour, 0.5, 0.5});
    const auto checker = std::make_shared<Lambertian>(std::make_shared<Checker>(n.side, Color{}, Color{1, 1, 1}));
    const auto picture = std::make_shared<Lambertian>(std::make_shared<ImageTexture>(
        std::make_shared<Image>(2, 2, Color{n.texel, 0, 0}), ImageTextureOptions{.filter = n.filter, .wrap = n.wrap}));
    const auto marble = std::make_shared<Lambertian>(std::make_shared<Marble>(n.frequency, n.seed));
    const auto metal = std::make_shared<Metal>(Color{0.5, 0.5, 0.5}, n.fuzz);
    const auto glass = std::make_shared<Dielectric>(n.index, n.fresnel);
    MeshData data;
    data.vertices = {{0, 0, 0}, {1, 0, 0}, {0, n.vertex, 0}, {0, 0, 1}};
    data.triangles = {{0, 2, 1}, {0, 1, n.last}};
    data.material_slots = {0, n.slot};
    const auto mesh = std::make_shared<Mesh>(data, std::vector<MaterialPtr>{colour, marble});
    const Object ball = sphere({0, 0, 0}, n.radius, glass),
                 quad_of = quad({n.corner, 0, 0}, {1, 0, 0}, {0, 1, 0}, checker);
    scene.add(n.order ? ball : quad_of);
    scene.add(n.order ? quad_of : ball);
    if (n.second_ball) scene.add(std::make_shared<Sphere>(Point3{3, 0, 0}, Point3{3, n.end, 0}, 0.5, metal));
    scene.add(std::make_shared<Triangle>(Point3{0, 0, 0}, Point3{1, 0, 0}, Point3{0, n.apex, 0}, picture));
    scene.add(std::make_shared<Instance>(mesh, Transform::rotate_y(n.turn)));
    scene.add(std::make_shared<ConstantMedium>(sphere({5, 5, 5}, 1, glass), n.density, Color{1, 1, 1}));
    return scene;
}

class Parametric : public Hittable {
public:
    explicit Parametric(double size) : size_(size) {}
    Box bounds() const override { return {{-1, -1, -1}, {1, 1, 1}}; }
    std::optional<Hit> hit(const Ray&) const override { return {}; }

protected:
    double size_;
};

class WithTag final : public Parametric, public Tagged {
public:
    using Parametric::Parametric;
    std::string tag() const override { return "parametric 1 " + std::to_string(size_); }
};

CompiledScene compiled_one(Object object) { return compile_with(sky(1), {std::move(object)}); }

}  // namespace

TEST_CASE("Digests: each number of a scene changes that of the scene", "[compile][digest]") {
    const std::vector<std::function<void(Numbers&)>> changes = {[](Numbers& n) { n.background = 0.25; },
                                                                [](Numbers& n) { n.colour = 0.125; },
                                                                [](Numbers& n) { n.fuzz = 0.25; },
                                                                [](Numbers& n) { n.index = 1.25; },
                                                                [](Numbers& n) { n.density = 3; },
                                                                [](Numbers& n) { n.turn = 180; },
                                                                [](Numbers& n) { n.end = 2; },
                                                                [](Numbers& n) { n.radius = -1; },
                                                                [](Numbers& n) { n.corner = 0.5; },
                                                                [](Numbers& n) { n.side = 2; },
                                                                [](Numbers& n) { n.apex = 3; },
                                                                [](Numbers& n) { n.frequency = 4; },
                                                                [](Numbers& n) { n.texel = 0.5; },
                                                                [](Numbers& n) { n.vertex = 0.25f; },
                                                                [](Numbers& n) { n.slot = 1; },
                                                                [](Numbers& n) { n.last = 2; },
                                                                [](Numbers& n) { n.seed = 8; },
                                                                [](Numbers& n) { n.fresnel = Fresnel::schlick; },
                                                                [](Numbers& n) { n.wrap = Wrap::clamp; },
                                                                [](Numbers& n) { n.filter = Filter::nearest; },
                                                                [](Numbers& n) { n.second_ball = false; },
                                                                [](Numbers& n) { n.order = false; }};
    std::set<Hash128> digests = {compile(scene_of({})).digest()};
    for (std::size_t i = 0; i < changes.size(); ++i) {
        CAPTURE(i);
        Numbers n;
        changes[i](n);
        CHECK(digests.insert(compile(scene_of(n)).digest()).second);
    }
}

TEST_CASE("Digests: the same scene has the same, at whatever addresses", "[compile][digest]") {
    const CompiledScene scene = compile(scene_of({}));
    CHECK(compile(scene_of({})).digest() == scene.digest());
    Scene named = scene_of({});
    named.name = "other";
    CHECK(compile(named).digest() == scene.digest());
    CHECK_FALSE(scene.has_untagged());
    // Whoever changes what is added up raises the version of films' format or samples: those of before would be refused
    // as of another scene.
    CHECK(scene.digest() == Hash128{0xd752c709c4ed93aa, 0x6468e9219649c5ea});
}

TEST_CASE("Digests: each detail of a material changes it", "[compile][digest]") {
    const auto of = [](const MaterialPtr& material) {
        return compile_with(sky(1), {sphere({0, 0, 0}, 1, material)}).digest();
    };
    const Color grey{.5, .5, .5};
    const std::set<Hash128> digests = {of(std::make_shared<RoughConductor>(grey, 0.5)),
                                       of(std::make_shared<RoughConductor>(grey, 0.4)),
                                       of(std::make_shared<RoughConductor>(grey, Roughness{0.5, 0.4})),
                                       of(std::make_shared<RoughConductor>(grey, 0.5, grey)),
                                       of(std::make_shared<RoughDielectric>(1.5, 0.5)),
                                       of(std::make_shared<Plastic>(grey, 0.5)),
                                       of(std::make_shared<Plastic>(grey, 0.5, 1.5, grey))};
    CHECK(digests.size() == 7);
}

TEST_CASE("Digests: user-defined objects are in it by their tags", "[compile][digest]") {
    const auto digest = [](Object object) { return compiled_one(std::move(object)).digest(); };
    CHECK(digest(std::make_shared<WithTag>(1)) == digest(std::make_shared<WithTag>(1)));
    CHECK(digest(std::make_shared<WithTag>(1)) != digest(std::make_shared<WithTag>(2)));
    CHECK_FALSE(compiled_one(std::make_shared<WithTag>(1)).has_untagged());
    CHECK(compiled_one(std::make_shared<Parametric>(1)).has_untagged());
}

}  // namespace limn::digest_test
