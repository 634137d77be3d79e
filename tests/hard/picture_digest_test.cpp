// One number for the picture of a scene and one for its records, the same in every build, on every instruction set, and
// whatever code the C library picks for the processor. A change of it is a change of samples: film_file.h has their
// version.
#include "catch.h"
#include "limn/limn.h"
#include "math/system/checksum.h"
#include "support/meshes.h"
#include "support/text.h"

namespace limn::picture_digest_test {

using namespace test;

namespace {

using MaterialPtr = std::shared_ptr<const Material>;

MaterialPtr matte(double r, double g, double b) { return std::make_shared<Lambertian>(Color{r, g, b}); }

// Turned boxes, one of them smoke, a fuzzy mesh, a lamp.
Scene room() {
    Scene scene;
    scene.name = "room";
    scene.background = Background::constant(Color{0.02, 0.03, 0.05});
    scene.add(std::make_shared<Quad>(Point3{-2, -1, -2}, Vec3{4, 0, 0}, Vec3{0, 0, 4}, matte(0.7, 0.7, 0.7)));
    scene.add(std::make_shared<Quad>(Point3{-2, -1, -2}, Vec3{4, 0, 0}, Vec3{0, 4, 0}, matte(0.6, 0.3, 0.2)));
    scene.add(std::make_shared<Quad>(Point3{-0.5, 2.5, -1}, Vec3{1, 0, 0}, Vec3{0, 0, 1},
                                     std::make_shared<DiffuseLight>(Color{9, 8, 7})));
    const auto box = make_box({-0.4, -1, -0.4}, {0.4, 0.3, 0.4}, matte(0.4, 0.6, 0.4));
    scene.add(std::make_shared<Instance>(box, Transform::translate({-1, 0, -0.7}) * Transform::rotate_y(18)));
    const auto smoke =
        std::make_shared<Instance>(box, Transform::translate({0.9, 0.2, 0}) * Transform::rotate({1, 2, 0.5}, 33) *
                                            Transform::scale(1.5, 1.5, 1.5));
    scene.add(std::make_shared<ConstantMedium>(smoke, 0.9, Color{0.8, 0.6, 0.9}));
    scene.add(std::make_shared<Mesh>(icosphere(2, 0.5, {-0.1, -0.5, 0.6}),
                                     std::make_shared<Metal>(Color{0.9, 0.8, 0.6}, 0.2)));
    return scene;
}

// Spheres with all built-in textures and lobes, under a sky, a sun and a spot.
Scene outdoors() {
    Scene scene;
    scene.name = "outdoors";
    const Sky sky = make_sky({.height = 16});
    scene.environment = sky.environment;
    scene.add(sky.sun);
    scene.add(
        SpotLight{.position = {0, 4, 2}, .direction = {0.1, -1, -0.6}, .intensity = {9, 9, 4}, .inner_cone_angle = 9});
    Image stored(8, 4);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 8; ++x)
            stored.set(x, y, Color{srgb_decode(x / 7.0), srgb_decode(y / 3.0), srgb_decode(0.5)});
    const auto picture = std::make_shared<ImageTexture>(std::move(stored));
    const MaterialPtr materials[] = {
        std::make_shared<Lambertian>(picture),
        std::make_shared<Lambertian>(std::make_shared<Marble>(4, 1)),
        std::make_shared<OrenNayar>(Color{0.7, 0.5, 0.3}, 0.5),
        std::make_shared<Lambertian>(std::make_shared<Noise>(5, 2)),
        std::make_shared<Dielectric>(1.5),
        std::make_shared<RoughDielectric>(1.4, 0.3),
        std::make_shared<RoughConductor>(Color{0.9, 0.6, 0.4}, Roughness{0.2, 0.5}),
        std::make_shared<Plastic>(Color{0.2, 0.3, 0.8}, 0.1),
        std::make_shared<MetallicRoughness>(Color{0.8, 0.7, 0.2}, 0.5, 0.4),
    };
    for (int i = 0; i < 9; ++i) {
        const Point3 center{1.1 * (i % 3 - 1), 1.1 * (i / 3 - 1), -0.3 * (i / 3)};
        scene.add(i == 3 ? std::make_shared<Sphere>(center, center + Vec3{0.2, 0.1, 0}, 0.5, materials[i])
                         : std::make_shared<Sphere>(center, 0.5, materials[i]));
    }
    scene.add(std::make_shared<Disk>(
        Point3{0, -1.7, 0}, Vec3{0, 1, 0.1}, 4,
        std::make_shared<Lambertian>(std::make_shared<Checker>(0.7, Color{0.1, 0.1, 0.1}, Color{0.8, 0.8, 0.8}))));
    return scene;
}

struct Digests {
    std::string picture;  // of the pixels and the estimate of their error
    std::string scene;    // CompiledScene::digest
};

Digests digests(const Scene& scene, const Camera& camera) {
    const CompiledScene compiled = compile(scene);
    const RenderResult r =
        render(compiled, camera, {.width = 32, .height = 32, .error = 0.02, .max_samples_per_pixel = 32});
    Checksum picture, records;
    for (const float v : r.image.values()) picture.add(v);
    for (const double v : {r.error.estimate, r.error.ci95_low, r.error.ci95_high, r.report.samples_per_pixel})
        picture.add(v);
    for (const std::uint64_t half : compiled.digest()) records.add(half);
    CHECK(r.error.reason.empty());
    return {hexadecimal(picture.value()), hexadecimal(records.value())};
}

}  // namespace

TEST_CASE("Digest: a picture of turned boxes and smoke has the same bits in every build", "[hard][digest]") {
    const Digests found = digests(room(), {.look_from = {0.3, 0.8, 5}, .look_at = {0, 0.4, 0}});
    CHECK(found.picture == "2258b0cd192febb1");
    CHECK(found.scene == "43d2f63aa82773c3");
}

TEST_CASE("Digest: a picture of all textures and lobes under a sky has the same bits in every build",
          "[hard][digest]") {
    const Digests found = digests(outdoors(), {.look_from = {0.5, 1, 6}, .aperture_angle = 1, .focus_distance = 6});
    CHECK(found.picture == "a6fecda11b85f559");
    CHECK(found.scene == "d3e5089ec69ff45c");
}

}  // namespace limn::picture_digest_test
