// Light from environment maps.
#include "limn/scene/environment.h"

#include "limn/image/compare.h"
#include "limn/scene/material/metal.h"
#include "limn/scene/material/oren_nayar.h"
#include "render/single_ray.h"
#include "support/chi_square.h"
#include "support/single_shading.h"

namespace limn::environment_test {

using namespace test;
using transport::PathTracer;

namespace {

CompiledScene compile_under(const EnvironmentMap& map, const std::vector<Object>& objects) {
    Scene scene;
    scene.environment = std::make_shared<EnvironmentMap>(map);
    for (const Object& object : objects) scene.add(object);
    return compile(scene);
}

// A dim gradient, and a sun of a few pixels with 1e5 times its mean.
Image sunny(int width) {
    Image image(width, width / 2);
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < width; ++x) image.set(x, y, {0.4 + 0.1 * y / image.height(), 0.5, 0.6});
    const int x = width * 5 / 8, y = image.height() / 5;
    for (int i = 0; i < 2; ++i) image.set(x + i, y, {5e4, 5e4, 4e4}), image.set(x + i, y + 1, {5e4, 5e4, 4e4});
    return image;
}

const Transform kTurned = Transform::rotate({1, 2, 0.5}, 40);

// Somebody else's diffuse reflector.
class UsersDiffuse final : public Material {
public:
    std::optional<ScatterSample> sample(const Surface& s, const Vec3&, const Random3& random) const override {
        const Vec3 in = Frame(Vec3(s.normal)).to_world(sample_cosine_hemisphere(random.x, random.y));
        return ScatterSample{in, Color{0.5, 0.5, 0.5}, dot(s.normal, in) / kPi};
    }
    ScatterValue value(const Surface& s, const Vec3&, const Vec3& in) const override {
        const double c = std::max(dot(s.normal, in), 0.0) / kPi;
        return {Color{0.5 * c, 0.5 * c, 0.5 * c}, c};
    }
};

std::vector<Object> still_life() {
    return {floor_of(grey(0.6)), sphere({-1.2, 0.5, 0}, 0.5, std::make_shared<UsersDiffuse>()),
            sphere({0, 0.5, 0}, 0.5, std::make_shared<Metal>(Color{0.9, 0.8, 0.5}, 0.4)),
            sphere({1.2, 0.5, 0}, 0.5, std::make_shared<OrenNayar>(Color{0.5, 0.3, 0.3}, 0.5)),
            std::make_shared<ConstantMedium>(sphere({0, 0.6, 1.2}, 0.5, nullptr), 2, Color{0.8, 0.8, 0.8})};
}

const Camera kEye = camera_at({0, 2.5, 6}, {0, 0.5, 0}, 35);

}  // namespace

TEST_CASE("Environment: draws go by the density that is claimed for them", "[render][environment]") {
    for (const int width : {1, 8, 64}) {
        Image image(width, std::max(1, width / 2), {1, 1, 1});
        Random values(9);
        for (float& v : image.values()) v = static_cast<float>(values.chance(0.3) ? 0 : values.log_uniform(0.01, 10));
        if (width == 1) image = Image(1, 1, {1, 2, 3});
        const CompiledScene scene = compile_under(EnvironmentMap(image, kTurned), {ball({0, 0, 0}, 1)});
        DirectionHistogram histogram({0, 0, 1});
        Random random(10);
        const Receiver receiver{{7, 8, 9}, {}};
        const int draws = kDraws / 5;
        for (int i = 0; i < draws; ++i) {
            const double pick = random.uniform(), u = random.uniform(), v = random.uniform();
            const auto s = sample_light(scene.flat(), receiver, 0, pick, u, v);
            REQUIRE(s);
            histogram.add(s->direction);
            if (i > 1000) continue;
            const Vec3& d = s->direction;
            const double pdf = pdf_light(scene.flat(), receiver, 0, flat::kFirstDistant, {d.x, d.y, d.z});
            CHECK(pdf == Approx(s->pdf).epsilon(1e-6));  // of directions that are rounded, near dark pixels
        }
        const auto density = [&](const Vec3& d) {
            return pdf_light(scene.flat(), receiver, 0, flat::kFirstDistant, {d.x, d.y, d.z});
        };
        INFO("width " << width);
        CHECK(histogram.p_value(density) > kSamplerLevel);
    }
}

TEST_CASE("Environment: under a small sun light sampling gives what scattering finds, with a fraction of its noise",
          "[render][environment]") {
    const CompiledScene scene = compile_under(EnvironmentMap(sunny(64), kTurned), still_life());
    const RenderResult by_light = render(scene, kEye, square(24, 1024, 4));
    const RenderResult by_scattering = render(scene, kEye, square(24, 8192, 4, Estimator::naive));
    const double truth = mean(by_light.image), other = mean(by_scattering.image);
    INFO("means " << truth << " and " << other);
    const double error = by_light.error.estimate,
                 naive = compare_images(by_scattering.image, by_light.image).relative_mse;
    INFO("relMSE " << error << " and " << naive);
    // The whole picture has the error of one of its 576 pixels over 24, more or less: these depend on each other
    // little.
    CHECK(std::abs(truth - other) <= 4.5 * std::sqrt(naive / 576) * truth);
    // Both errors fall as 1 / samples, so that rays times error say what a relMSE of 1e-3 takes.
    CHECK(20 * static_cast<double>(by_light.report.rays) * error <=
          static_cast<double>(by_scattering.report.rays) * naive);
}

TEST_CASE("Environment: what a ray sees of a map is what the map says, to the bit", "[render][environment]") {
    const EnvironmentMap map(sunny(32), kTurned, 0.7);
    const CompiledScene scene = compile_under(map, {});
    PathTracer tracer(scene.flat(), 4, Estimator::path);
    Random random(6);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 direction = random.log_uniform(1e-3, 1e3) * random.unit();
        const transport::Sampler numbers(1, static_cast<std::uint64_t>(i), 0);
        CHECK(tracer.radiance(Ray{{1, 2, 3}, direction}, numbers) == map.radiance(direction));
    }
}

TEST_CASE("Environment: one bright pixel, wherever it is, gives a floor its integral", "[render][environment]") {
    for (const auto& [x, y] : {std::pair{0, 0}, {7, 1}, {3, 2}, {15, 3}}) {
        Image image(16, 8);
        image.set(x, y, {400, 400, 400});
        const EnvironmentMap map(image);
        double irradiance = 0;
        constexpr int kSteps = 1000;
        for (int i = 0; i < kSteps; ++i)
            for (int j = 0; j < 2 * kSteps; ++j) {
                const double cosine = (i + 0.5) / kSteps, turn = kPi * (j + 0.5) / kSteps;
                const double sine = std::sqrt(1 - cosine * cosine);
                const Vec3 d{sine * std::cos(turn), cosine, sine * std::sin(turn)};
                irradiance += map.radiance(d).g * cosine;
            }
        irradiance *= kPi / kSteps / kSteps;
        const CompiledScene scene = compile_under(map, {floor_of(grey(kAlbedo))});
        INFO("pixel " << x << ' ' << y);
        check_mean(along(scene, at_floor(), 2, Estimator::path, 20'000), kAlbedo / kPi * irradiance, 0.02);
    }
}

TEST_CASE("Environment: a black map lights nothing and is not sampled", "[render][environment]") {
    for (const EnvironmentMap& map : {EnvironmentMap(Image(8, 4)), EnvironmentMap(Image(8, 4, {1, 1, 1}), {}, 0)}) {
        const CompiledScene scene = compile_under(map, still_life());
        CHECK(scene.flat().lights.empty());
        CHECK(mean(render(scene, kEye, square(8, 8, 4)).image) == 0);
    }
}

TEST_CASE("Environment: a map of 16384 pixels a row is sampled to its last pixel", "[render][environment]") {
    Image image(16384, 4, {1e-3, 1e-3, 1e-3});
    for (const int x : {0, 8191, 16383}) image.set(x, 1, {1e5, 1e5, 1e5});
    const CompiledScene scene = compile_under(EnvironmentMap(image), {ball({0, 0, 0}, 1)});
    const Receiver receiver{{7, 8, 9}, {}};
    Random random(11);
    int found[3] = {};
    for (int i = 0; i < 3000; ++i) {
        const double pick = random.uniform(), u = random.uniform(), v = random.uniform();
        const auto s = sample_light(scene.flat(), receiver, 0, pick, u, v);
        REQUIRE(s);
        const double column = 16384 * (0.5 + std::atan2(s->direction.x, -s->direction.z) / (2 * kPi));
        found[0] += std::abs(column - 0.5) < 1.01, found[1] += std::abs(column - 8191.5) < 1.01;
        found[2] += std::abs(column - 16383.5) < 1.01;
    }
    for (const int count : found) CHECK(std::abs(count - 1000) < 140);  // 4.5 sigma of 3000 draws of a third: 116
}

TEST_CASE("Environment: pixels do not depend on threads, and another map has another digest", "[render][environment]") {
    const CompiledScene scene = compile_under(EnvironmentMap(sunny(64)), still_life());
    RenderSettings settings = square(20, 16, 5);
    settings.threads = 1;
    const Image image = render(scene, kEye, settings).image;
    settings.threads = 3;
    CHECK(render(scene, kEye, settings).image == image);
    const Hash128 digest = scene.digest();
    Image other = sunny(64);
    other.values()[100] += 0.125f;
    CHECK(compile_under(EnvironmentMap(sunny(64)), still_life()).digest() == digest);
    CHECK(compile_under(EnvironmentMap(other), still_life()).digest() != digest);
    CHECK(compile_under(EnvironmentMap(sunny(64), kTurned), still_life()).digest() != digest);
    CHECK(compile_under(EnvironmentMap(sunny(64), {}, 2), still_life()).digest() != digest);
}

TEST_CASE("Environment: a render to an error reaches it under a sun", "[render][environment]") {
    const CompiledScene scene = compile_under(EnvironmentMap(sunny(64), kTurned), still_life());
    RenderSettings settings = square(32, 1, 4);
    settings.error = 2e-3;
    const RenderResult r = render(scene, kEye, settings);
    RenderSettings many = square(32, 4096, 4);
    many.seed = 77;
    CHECK(compare_images(r.image, render(scene, kEye, many).image).relative_mse <= 2 * 2e-3);
}

}  // namespace limn::environment_test
