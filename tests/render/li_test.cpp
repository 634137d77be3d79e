// The path tracer and its reference, in scenes of what the scenes of ./build.sh convergence lack (tests/bench).
#include "limn/limn.h"
#include "support/pictures.h"
#include "support/reference_paths.h"

namespace limn::li_test {

using namespace test;

namespace {

// A user's material, whose lobe is a loop over calls.
class Own final : public Material {
public:
    std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& r) const override {
        return matte_.sample(s, out, r);
    }
    ScatterValue value(const Surface& s, const Vec3& out, const Vec3& in) const override {
        return matte_.value(s, out, in);
    }
    Color emitted(const Surface& s) const override { return {0.1 * s.normal.y * s.normal.y, 0, 0}; }

private:
    Lambertian matte_{Color{0.4, 0.6, 0.7}};
};

// Shapes in motion, holes, media across each other, and lamps of several kinds.
Scene room() {
    const auto half = [](MaterialPtr inner, double opacity) {
        return std::make_shared<AlphaMask>(std::move(inner), opacity);
    };
    Scene scene;
    for (const Object& object : std::vector<Object>{
             floor_of(grey(0.7)), quad({-2, 0, -2}, {4, 0, 0}, {0, 4, 0}, half(grey(0.6), 0.7)),
             quad({-2, 0, -3}, {4, 0, 0}, {0, 4, 0}, std::make_shared<Own>()),
             quad({-1, 3, -1}, {1, 0, 0}, {0, 0, 1}, half(lamp(6), 0.5)),
             std::make_shared<Sphere>(Point3{1, 2, 0}, Point3{1.2, 2.2, 0.1}, 0.2, lamp(9)),
             sphere({-1, 0.5, 0.5}, 0.5, std::make_shared<Dielectric>(1.5)),
             std::make_shared<Stranger>(sphere({0, 0.4, 1}, 0.4, std::make_shared<Own>())),
             std::make_shared<ConstantMedium>(make_box({-2, -1, -2}, {2, 3, 2}, nullptr), 0.1, Color{0.9, 0.8, 0.7}),
             std::make_shared<ConstantMedium>(sphere({0.5, 1, 0.5}, 0.8, nullptr), 0.8, Color{0.3, 0.6, 0.9}),
             std::make_shared<Stranger>(std::make_shared<ConstantMedium>(sphere({1, 1, 1}, 0.5, nullptr), 0, Color{}))})
        scene.add(object);
    scene.add(PointLight{.position = {-1, 2.5, 1}, .intensity = {2, 1, 1}});
    return scene;
}

// Under a background with a directional light, and under an environment map with a sun.
Scene outdoors(bool with_map) {
    Scene scene = room();
    scene.background = Background::gradient({1, 1, 1}, {0.5, 0.7, 1});
    scene.add(DirectionalLight{.direction = {0.1, -1, 0.3}});
    if (!with_map) return scene;
    const Sky sky = make_sky({.height = 16});
    scene.environment = sky.environment;
    scene.add(SunLight{.direction = {-1, -2, -1}, .irradiance = {3, 3, 3}, .angular_radius = 5});
    return scene;
}

}  // namespace

TEST_CASE("Li: with holes, motion, media and lights of every kind each sample is the reference's", "[render][li]") {
    const Camera camera{.look_from = {0.5, 1.5, 6}, .look_at = {0, 1, 0}, .vertical_fov = 50, .aperture_angle = 1};
    for (const Scene& description : {room(), outdoors(false), outdoors(true)}) {
        const CompiledScene scene = compile(description);
        for (const int depth : {1, 2, 9, kUnlimitedDepth})
            for (const Estimator estimator : {Estimator::path, Estimator::naive})
                for (const bool transparent : {false, true}) {
                    RenderSettings settings = square(32, 1, depth, estimator);
                    settings.transparent = transparent;
                    settings.sampler = transparent ? SamplerKind::independent : SamplerKind::sobol;
                    const ComparedPaths compared = compare_paths(scene, camera, settings);
                    CAPTURE(depth, estimator, transparent);
                    CHECK(compared.differing == 0);
                    CHECK(compared.mean > 0);
                }
    }
}

}  // namespace limn::li_test
