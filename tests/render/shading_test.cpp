// A packed material or texture answers as the described object does, bit for bit.
#include "limn/scene/material/alpha_mask.h"
#include "limn/scene/material/normal_map.h"
#include "limn/scene/texture/checker.h"
#include "limn/scene/texture/image_texture.h"
#include "limn/scene/texture/perlin.h"
#include "limn/scene/texture/solid.h"
#include "lobe_examples.h"
#include "property.h"
#include "render/path.h"
#include "support/pictures.h"
#include "support/random_geometry.h"
#include "support/single_shading.h"

namespace limn::shading_test {

using namespace test;

namespace {

using TexturePtr = std::shared_ptr<const Texture>;

class Striped final : public Texture {
public:
    Color value(const Surface& s) const override { return {std::abs(std::sin(s.position.x)), 0.5, s.uv.v}; }
};

// Answers with what it is asked.
class Echo final : public Material {
public:
    Color emitted(const Surface& s) const override { return {s.uv.u, s.uv.v, 0}; }
    std::optional<ScatterSample> sample(const Surface& s, const Vec3& out, const Random3& r) const override {
        if (r.x < 0.3) return std::nullopt;
        return ScatterSample{.direction = out, .weight = {r.x, r.y, s.uv.u}, .pdf = r.z};
    }
    ScatterValue value(const Surface& s, const Vec3& out, const Vec3& in) const override {
        return {.value = {s.uv.u, std::abs(out.x), std::abs(in.x)}, .pdf = std::abs(in.y)};
    }
};

std::vector<TexturePtr> textures() {
    Image image(3, 2);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x) image.set(x, y, {0.1 * x, 0.3 * y, 0.5});
    const Color color{0.9, 0.6, 0.3};
    const auto striped = std::make_shared<Striped>();
    return {std::make_shared<SolidColor>(color),
            std::make_shared<Checker>(0.7, color, Color{0.1, 0.2, 0.3}),
            std::make_shared<Checker>(0.7, std::make_shared<Checker>(0.2, Color{}, color), striped),
            std::make_shared<ImageTexture>(image, ImageTextureOptions{Filter::nearest, Wrap::mirror}),
            std::make_shared<ImageTexture>(image, ImageTextureOptions{Filter::bilinear, Wrap::clamp}),
            std::make_shared<Noise>(2.5, 3, color),
            std::make_shared<Turbulence>(2.5, 3, color),
            std::make_shared<Marble>(2.5, 4, color),
            striped};
}

std::vector<MaterialPtr> materials() {
    const TexturePtr checker = std::make_shared<Checker>(0.7, Color{0.9, 0.6, 0.3}, Color{0.1, 0.2, 0.3});
    std::vector<MaterialPtr> all = lobe_examples();
    for (const MaterialPtr& material : std::initializer_list<MaterialPtr>{
             std::make_shared<DiffuseLight>(checker),
             std::make_shared<NormalMap>(std::make_shared<RoughConductor>(checker, 0.5), checker),
             std::make_shared<NormalMap>(std::make_shared<Plastic>(checker, 0), checker),
             std::make_shared<NormalMap>(std::make_shared<Dielectric>(1.5), checker),
             std::make_shared<NormalMap>(std::make_shared<Echo>(), checker),
             std::make_shared<AlphaMask>(std::make_shared<Lambertian>(checker), checker), std::make_shared<Echo>()})
        all.push_back(material);
    return all;
}

Surface random_surface(Random& random) {
    Surface s;
    s.position = Point3{} + random.in_cube(5);
    s.normal = Normal3(random.unit());
    const Vec3 bent = normalize(Vec3(s.normal) + 0.5 * random.unit());
    s.shading_normal = random.chance(0.5) ? s.normal : Normal3(bent);
    s.uv = {random.uniform(-1, 2), random.uniform(-1, 2)};
    s.front_face = random.chance(0.5);
    if (random.chance(0.7)) s.dp_du = random.in_cube(3), s.dp_dv = random.in_cube(3);
    return s;
}

// On the side of the surface, unless it is NaN.
Vec3 above(Random& random, const Surface& s) {
    const Vec3 w = random.unit();
    return dot(w, s.normal) < 0 ? -w : w;
}

// A scene of balls side by side, one for each material, and the materials' rows in it.
struct Packed {
    CompiledScene scene;
    std::vector<MaterialRef> rows;

    explicit Packed(const std::vector<MaterialPtr>& all) : scene(compile_with(sky(0), balls(all))) {
        for (std::size_t i = 0; i < all.size(); ++i) {
            const Ray ray{.origin = {3.0 * static_cast<double>(i), 0, 5}, .direction = {0, 0, -1}};
            rows.push_back(scene.surface_at(ray, scene.closest_hit(ray).value()).material);
        }
    }
    static std::vector<Object> balls(const std::vector<MaterialPtr>& all) {
        std::vector<Object> objects;
        for (std::size_t i = 0; i < all.size(); ++i)
            objects.push_back(sphere({3.0 * static_cast<double>(i), 0, 0}, 1, all[i]));
        return objects;
    }
};

bool same(const std::optional<ScatterSample>& a, const std::optional<ScatterSample>& b) {
    if (!a || !b) return a.has_value() == b.has_value();
    return a->direction == b->direction && a->weight == b->weight && a->pdf == b->pdf;
}

}  // namespace

TEST_CASE("Shading: a packed texture has the described one's value, bit for bit", "[render][shading]") {
    const std::vector<TexturePtr> described = textures();
    std::vector<MaterialPtr> lamps;
    for (const TexturePtr& t : described) lamps.push_back(std::make_shared<DiffuseLight>(t));
    const Packed packed(lamps);
    holds([&](std::uint64_t seed) {
        Random random(seed);
        for (std::size_t i = 0; i < described.size(); ++i) {
            Surface s = random_surface(random);
            s.material = packed.rows[i];
            RC_ASSERT(shade::emitted(packed.scene.flat(), s) == described[i]->value(s));
        }
    });
}

TEST_CASE("Shading: a packed material emits, samples and scatters as the described one, bit for bit",
          "[render][shading]") {
    const std::vector<MaterialPtr> described = materials();
    const Packed packed(described);
    const flat::Scene& scene = packed.scene.flat();
    holds([&](std::uint64_t seed) {
        Random random(seed);
        for (std::size_t i = 0; i < described.size(); ++i) {
            Surface s = random_surface(random);
            const bool by_object = random.chance(0.2);  // as on a surface of somebody else's shape
            s.material = by_object ? material_ref(described[i].get()) : packed.rows[i];
            const Vec3 out = above(random, s), in = random.unit();
            const double x = random.uniform(), y = random.uniform();
            const Random3 r{x, y, random.uniform()};
            RC_ASSERT(shade::emitted(scene, s) == described[i]->emitted(s));
            const Vec3 unit = normalize(out);  // as of a ray of any length
            RC_ASSERT(same(sample_material(scene, s, out, r), described[i]->sample(s, unit, r)));
            const ScatterValue a = material_value(scene, s, out, in), b = described[i]->value(s, unit, in);
            RC_ASSERT(a.value == b.value && a.pdf == b.pdf);
            if (!is_black(b.value)) RC_ASSERT(!shade::is_specular(scene, s.material));
        }
    });
}

TEST_CASE("Shading: lights are sampled for what scatters into more than a direction", "[render][shading]") {
    const std::vector<MaterialPtr> described = materials();
    const Packed packed(described);
    Random random(9);
    for (std::size_t i = 0; i < described.size(); ++i) {
        CAPTURE(i);
        bool scatters = false, has_pdf = false;
        for (int round = 0; round < 100; ++round) {
            const Surface s = random_surface(random);
            const Vec3 out = above(random, s);
            const double x = random.uniform(), y = random.uniform();
            const auto sample = described[i]->sample(s, out, {x, y, random.uniform()});
            scatters |= sample.has_value();
            has_pdf |= sample && sample->pdf > 0;
        }
        CHECK(shade::is_specular(packed.scene.flat(), packed.rows[i]) == (scatters && !has_pdf));
    }
}

TEST_CASE("Shading: a surface without a material neither emits nor scatters", "[render][shading]") {
    const Packed packed({grey(0.5)});
    const flat::Scene& scene = packed.scene.flat();
    Surface s;
    s.normal = s.shading_normal = {0, 0, 1};
    CHECK(is_black(shade::emitted(scene, s)));
    CHECK_FALSE(sample_material(scene, s, {0, 0, 1}, {0.5, 0.5, 0.5}));
    CHECK(is_black(material_value(scene, s, {0, 0, 1}, {0, 0, 1}).value));
}

TEST_CASE("Shading: a ray that meets nothing brings the background of its direction, to the bit", "[render]") {
    const Background background = Background::gradient({0.9, 0.1, 0.2}, {0, 0.3, 0.8});
    const CompiledScene scene = compile_with(background, {});
    transport::PathTracer tracer(scene.flat(), 1, Estimator::path);
    Random random(17);
    for (std::uint64_t i = 0; i < 100; ++i) {
        const Vec3 direction = random.unit();
        transport::Sampler numbers(1, 2, i);
        CHECK(tracer.radiance(Ray{{1, 2, 3}, direction}, numbers) == background.radiance(direction));
    }
}

}  // namespace limn::shading_test
