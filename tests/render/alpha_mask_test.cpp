// Holes in surfaces: what passes them, to the eye and to lamps.
#include "limn/scene/material/alpha_mask.h"

#include "catch.h"
#include "limn/limn.h"
#include "limn/math/error.h"
#include "support/pictures.h"

namespace limn::alpha_mask_test {

using namespace test;

namespace {

const auto kBlack = std::make_shared<Lambertian>(Color{});

// u from 0 to 1 in equal parts, of these opacities.
std::shared_ptr<const Texture> parts(const std::vector<double>& opacities) {
    Image image(static_cast<int>(opacities.size()), 1);
    for (std::size_t i = 0; i < opacities.size(); ++i)
        image.set(static_cast<int>(i), 0, {opacities[i], opacities[i], opacities[i]});
    return std::make_shared<ImageTexture>(image, ImageTextureOptions{Filter::nearest, Wrap::clamp});
}

Object upright(double x0, double x1, double z, std::shared_ptr<const Material> material) {
    return std::make_shared<Quad>(Point3{x0, -2, z}, Vec3{x1 - x0, 0, 0}, Vec3{0, 4, 0}, std::move(material));
}

Image picture(const std::vector<Object>& objects, Estimator estimator = Estimator::path, double sky = 0,
              int samples = 64) {
    Scene scene;
    scene.background = Background::constant({sky, sky, sky});
    for (const Object& object : objects) scene.add(object);
    const Camera camera{.look_from = {0, 0, 6}, .look_at = {0, 0, 0}, .vertical_fov = 20};
    RenderSettings settings{.width = 16, .height = 16, .samples_per_pixel = samples};
    settings.estimator = estimator;
    return render(compile(scene), camera, settings).image;
}

bool same(const Image& a, const Image& b) {
    return std::equal(a.values().begin(), a.values().end(), b.values().begin(), b.values().end());
}

// A wall, and a lamp that shines on it past what is at z = 1.
std::vector<Object> lit_wall(std::vector<Object> between) {
    between.push_back(upright(-2, 2, 0, std::make_shared<Lambertian>(Color{.8, .8, .8})));
    between.push_back(std::make_shared<Sphere>(Point3{3, 0, 4}, 0.5, std::make_shared<DiffuseLight>(Color{9, 9, 9})));
    return between;
}

}  // namespace

TEST_CASE("AlphaMask: layers of black let through what their opacities leave", "[render][alpha-mask]") {
    for (const double opacity : {0.0, 0.25, 0.7, 1.0})
        for (const int layers : {1, 2, 3}) {
            CAPTURE(opacity, layers);
            std::vector<Object> objects;
            for (int i = 0; i < layers; ++i)
                objects.push_back(upright(-2, 2, 0.1 * i, std::make_shared<AlphaMask>(kBlack, opacity)));
            const double expected = std::pow(1 - opacity, layers);
            // Of 16 * 16 * 256 samples, four deviations.
            const double deviation = std::sqrt(expected * (1 - expected)) / 256;
            CHECK(std::abs(mean(picture(objects, Estimator::path, 1, 256)) - expected) <= 4 * deviation);
        }
}

TEST_CASE("AlphaMask: a hole throws no shadow and its rim does, to the bit", "[render][alpha-mask]") {
    // What is opaque on the right half, against a square that is no larger.
    const auto half = std::make_shared<AlphaMask>(kBlack, parts({0, 1}));
    const Image masked = picture(lit_wall({upright(0.5, 1.5, 1, half)}));
    CHECK(same(masked, picture(lit_wall({upright(1, 1.5, 1, kBlack)}))));
    CHECK_FALSE(same(masked, picture(lit_wall({upright(0.5, 1.5, 1, kBlack)}))));
    CHECK_FALSE(same(masked, picture(lit_wall({}))));
}

TEST_CASE("AlphaMask: a hole in front of the very same plane shows it", "[render][alpha-mask]") {
    const auto hole = std::make_shared<AlphaMask>(kBlack, 0);
    CHECK(same(picture(lit_wall({upright(-2, 2, 0, hole), upright(-1, 2, 0, hole)})), picture(lit_wall({}))));
}

TEST_CASE("AlphaMask: with a cutoff a surface is there or not", "[render][alpha-mask]") {
    const auto wall = [](double opacity, double cutoff) {
        const auto mask = std::make_shared<AlphaMask>(kBlack, parts({opacity}), cutoff);
        return picture(lit_wall({upright(0.5, 1.5, 1, mask)}));
    };
    CHECK(same(wall(0.5, 0.5), wall(1, 0)));
    CHECK(same(wall(0.75, 0.5), wall(1, 0)));
    CHECK(same(wall(0.25, 0.5), wall(0, 0)));
}

TEST_CASE("AlphaMask: both estimators find the light that passes, and that of lamps with holes",
          "[render][alpha-mask]") {
    const auto lamp = std::make_shared<DiffuseLight>(Color{9, 9, 9});
    const std::vector<Object> scenes[] = {
        lit_wall({upright(0, 2, 1, std::make_shared<AlphaMask>(kBlack, 0.4)),
                  upright(0, 2, 1.5, std::make_shared<AlphaMask>(kBlack, parts({1, .5, 0})))}),
        {upright(-2, 2, 0, std::make_shared<Lambertian>(Color{.8, .8, .8})),
         std::make_shared<Quad>(Point3{-3, -3, 6.5}, Vec3{6, 0, 0}, Vec3{0, 6, 0},
                                std::make_shared<AlphaMask>(lamp, parts({1, .25, 0})))}};
    for (const std::vector<Object>& objects : scenes) {
        const double path = mean(picture(objects, Estimator::path, 0, 1024));
        CHECK(mean(picture(objects, Estimator::naive, 0, 4096)) == Approx(path).epsilon(0.02));
    }
}

TEST_CASE("AlphaMask: round lamps with holes give what scattering finds, from their far walls too",
          "[render][alpha-mask]") {
    const auto wall = upright(-2, 2, 0, std::make_shared<Lambertian>(Color{.8, .8, .8}));
    const auto lamp = [](Sides sides) { return std::make_shared<DiffuseLight>(Color{9, 9, 9}, sides); };
    const auto ball = [](MaterialPtr material) { return sphere({0, 0, 0}, 1, std::move(material)); };
    const Object masked[] = {ball(std::make_shared<AlphaMask>(lamp(Sides::both), 0.5)),
                             ball(std::make_shared<AlphaMask>(lamp(Sides::back), 0.5)),
                             ball(std::make_shared<AlphaMask>(lamp(Sides::front), parts({1, 0})))};
    for (const Object& object : masked) {
        const Transform place = Transform::translate({3, 0, 3}) * Transform::rotate_y(180);
        const std::vector<Object> objects{wall, std::make_shared<Instance>(object, place)};
        const double path = mean(picture(objects, Estimator::path, 0, 1024));
        CHECK(path > 0);
        CHECK(mean(picture(objects, Estimator::naive, 0, 1024)) == Approx(path).epsilon(0.03));
    }
}

TEST_CASE("AlphaMask: lamps with user-defined opacities are not sampled, as those of such light",
          "[render][alpha-mask]") {
    struct Own final : Texture {
        Color value(const Surface&) const override { return {0.5, 0.5, 0.5}; }
    };
    const auto lamp = std::make_shared<DiffuseLight>(Color{9, 9, 9});
    const auto lights = [](MaterialPtr material) {
        return compile_with(Background::black(), {upright(-1, 1, 0, std::move(material))}).stats().lights;
    };
    CHECK(lights(std::make_shared<AlphaMask>(lamp, 0.5)) == 1);
    CHECK(lights(std::make_shared<AlphaMask>(lamp, std::make_shared<Own>())) == 0);
}

TEST_CASE("AlphaMask: a picture without its background has their holes in its alpha", "[render][alpha-mask]") {
    RenderSettings settings = square(8, 64, 4);
    settings.transparent = true;
    const CompiledScene scene =
        compile_with(Background::black(), {upright(-2, 2, 0, std::make_shared<AlphaMask>(kBlack, 0.25))});
    const RenderResult result = render(scene, camera_at({0, 0, 6}, {0, 0, 0}, 20), settings);
    double sum = 0;
    for (const float alpha : result.maps.alpha) sum += static_cast<double>(alpha);
    CHECK(sum / 64 == Approx(0.25).margin(0.02));
}

TEST_CASE("AlphaMask: queries tell of the whole surface", "[render][alpha-mask]") {
    const CompiledScene scene = compile_with(sky(1), {upright(-1, 1, 0, std::make_shared<AlphaMask>(kBlack, 0))});
    CHECK(scene.any_hit(Ray{{0, 0, 5}, {0, 0, -1}}));
}

TEST_CASE("AlphaMask: what is out of range is refused", "[render][alpha-mask]") {
    CHECK_THROWS_AS(AlphaMask(nullptr, 0.5), ArgumentError);
    CHECK_THROWS_AS(AlphaMask(kBlack, std::shared_ptr<const Texture>()), ArgumentError);
    for (const double bad : {-0.1, 1.1, std::nan("")}) {
        CHECK_THROWS_AS(AlphaMask(kBlack, bad), ArgumentError);
        CHECK_THROWS_AS(AlphaMask(kBlack, parts({1}), bad), ArgumentError);
    }
    RecordSink sink;
    CHECK_THROWS_AS(AlphaMask(std::make_shared<AlphaMask>(kBlack, 0.5), 0.5).lower(sink), ArgumentError);
}

}  // namespace limn::alpha_mask_test
