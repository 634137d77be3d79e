// Vertices shaded together: the same as one by one, whatever the vectors and the rest of the batch.
#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <memory>

#include "catch.h"
#include "limn/limn.h"
#include "lobe_examples.h"
#include "math/sobol.h"
#include "random_light.h"
#include "render/sampler.h"
#include "shading/stages.h"
#include "support/random_geometry.h"
#include "support/single_shading.h"
#include "support/targets.h"

namespace limn::lobes_test {

using namespace test;
using bsdf::Vertices;
using sampling::kShaded, sampling::Row, sampling::Rows3;
using transport::Sampler;

namespace {

Surface random_surface(Random& random, bool inside) {
    Surface s;
    s.position = Point3{} + (random.chance(0.1) ? Vec3{0, 1, -2} : random.in_cube(2));
    s.position_error = random.chance(0.1) ? Vec3{} : random.log_uniform(1e-18, 1e-6) * Vec3{1, 1, 1};
    s.front_face = random.chance(0.5);
    if (inside) return s;
    const Vec3 normal = random.chance(0.1) ? Vec3{0, 0, random.sign()} : random.unit();
    s.normal = s.shading_normal = Normal3(normal);
    if (random.chance(0.5)) s.shading_normal = Normal3(normalize(normal + 0.3 * random.in_cube()));
    if (random.chance(0.7)) s.dp_du = random.in_cube(), s.dp_dv = random.in_cube();
    return s;
}

const Color kAlbedo{0.75, 0.5, 0.125};

// Materials of one lobe in a scene of their own.
struct Compiled {
    CompiledScene scene;
    std::vector<MaterialPtr> materials;

    explicit Compiled(const std::vector<MaterialPtr>& of_a_lobe)
        : scene(compile(of(of_a_lobe))), materials(of_a_lobe) {}
    static Scene of(const std::vector<MaterialPtr>& materials) {
        Scene scene;
        for (const auto& m : materials) scene.add(std::make_shared<Sphere>(Point3{}, 1, m));
        return scene;
    }
    const bsdf::Lobe& lobe() const { return *scene.flat().materials[0].lobe; }
};

// The examples of each lobe.
std::vector<Compiled> compiled_examples() {
    std::map<const bsdf::Lobe*, std::vector<MaterialPtr>> of_lobe;
    for (const MaterialPtr& material : lobe_examples()) {
        RecordSink sink;
        of_lobe[material->lower(sink).lobe].push_back(material);
    }
    std::vector<Compiled> all;
    for (const auto& [lobe, materials] : of_lobe) all.emplace_back(materials);
    return all;
}

struct Batch {
    std::array<Surface, kShaded> surfaces;
    std::array<Vec3, kShaded> outs;
    Vertices vertices;
    Rows3 in;

    Batch(Random& random, const Compiled& compiled, std::size_t count = kShaded) {
        vertices.count = count;
        for (std::size_t i = 0; i < count; ++i) {
            surfaces[i] = random_surface(random, !compiled.lobe().one_sided && random.chance(0.5));
            surfaces[i].material.id = static_cast<std::uint32_t>(random.index(compiled.materials.size()));
            outs[i] = random.unit();
            if (dot(outs[i], surfaces[i].normal) < 0) outs[i] = -outs[i];
            const Vec3 incoming = -random.log_uniform(1e-3, 1e3) * outs[i];
            outs[i] = -normalize(incoming);
            shade::set_vertex(compiled.scene.flat(), surfaces[i], incoming, vertices, i);
            for (auto& number : vertices.numbers) number[i] = random.chance(0.05) ? 0 : random.uniform();
            in.set(i, random.unit());
        }
    }
};

}  // namespace

TEST_CASE("Lobes: many samplers at once draw what each draws alone", "[render][sampler][lobes]") {
    on_every_target([] {
        std::size_t wrong = 0;
        Row numbers[5];
        for (std::uint64_t round = 0; round < 40; ++round) {
            std::vector<Sampler> samplers;
            const std::size_t count = round < kShaded ? round + 1 : kShaded;
            std::uint64_t base[kShaded] = {};
            std::uint32_t index[kShaded] = {}, group[kShaded] = {};
            for (std::uint32_t i = 0; i < count; ++i) {
                samplers.emplace_back(round, i, (std::uint64_t{i} * i + round) << (i % 24));
                base[i] = samplers[i].base(), index[i] = samplers[i].index();
                group[i] = Sampler::group_of(i % 7, static_cast<transport::Use>(i % 4));
            }
            for (const std::size_t dimensions : {1u, 2u, 3u, 5u}) {
                sobol::draw({count, base, index, group}, dimensions, numbers);
                for (std::size_t i = 0; i < count; ++i) {
                    const auto alone = samplers[i].numbers_of(group[i]);
                    for (std::size_t d = 0; d < dimensions; ++d) wrong += alone[d] != numbers[d][i];
                }
            }
        }
        CHECK(wrong == 0);
    });
}

TEST_CASE("Lobes: vertices scatter as their materials do, bit for bit", "[render][shading][lobes]") {
    for (const Compiled& compiled : compiled_examples()) {
        INFO(compiled.scene.flat().materials[0].kind);
        on_every_target([&] {
            Random random(5);
            std::size_t samples = 0, values = 0, origins = 0;
            shade::Paths paths;
            const auto next = std::make_unique<shade::Segments>();
            for (int round = 0; round < 300; ++round) {
                Batch b(random, compiled, 1 + random.index(kShaded));
                Vertices& v = b.vertices;
                compiled.lobe().sample(v);
                compiled.lobe().value(v, b.in);
                for (std::size_t i = 0; i < v.count; ++i) paths.path[i] = static_cast<std::uint32_t>(i);
                shade::Roulette never{.start = 2, .factor = 1, .largest = 1};
                Row survival, odds = {};
                const Row number = {};
                for (std::size_t i = 0; i < v.count; ++i) paths.throughput.set(i, Color{1, 1, 1});
                const bool some_end = shade::scatter(never, v, paths, survival);
                CHECK(some_end == std::any_of(survival, survival + v.count, [](double s) { return s == 0; }));
                next->count = 0;
                const auto counts = shade::add_segments(paths, v, true, survival, number, odds, *next);
                CHECK((counts.all == next->count && counts.unusable == 0));
                for (std::size_t i = 0; i < v.count; ++i) {
                    const Random3 numbers{v.numbers[0][i], v.numbers[1][i], v.numbers[2][i]};
                    const Material* const material = compiled.materials[b.surfaces[i].material.id].get();
                    const auto alone = material->sample(b.surfaces[i], b.outs[i], numbers);
                    const Vec3 direction = v.direction.get<Vec3>(i);
                    samples += alone ? alone->direction != direction || alone->pdf != v.pdf[i] ||
                                           alone->weight != v.weight.get<Color>(i)
                                     : !is_black(v.weight.get<Color>(i));
                    const ScatterValue value = material->value(b.surfaces[i], b.outs[i], b.in.get<Vec3>(i));
                    values += value.value != v.value.get<Color>(i) || value.pdf != v.value_pdf[i];
                }
                std::size_t row = 0;
                for (std::size_t i = 0; i < v.count; ++i) {
                    if (is_black(v.weight.get<Color>(i))) continue;
                    const Ray ray = b.surfaces[i].spawn_ray(v.direction.get<Vec3>(i), 0);
                    origins += next->path[row] != i || ray.origin != next->origin.get<Point3>(row) ||
                               ray.direction != next->direction.get<Vec3>(row) ||
                               next->throughput.get<Color>(row) != v.weight.get<Color>(i);
                    ++row;
                }
                origins += row != next->count;
            }
            CHECK(samples == 0);
            CHECK(values == 0);
            CHECK(origins == 0);
        });
    }
}

TEST_CASE("Lobes: rays leave in lanes from where they leave alone, bit for bit, also at hard numbers",
          "[render][shading][lobes]") {
    const std::array sizes{
        0.0, 0x1p-1074, 0x1p-1022, 0x1p-60, 0.6, 1.0, 1 + 0x1p-52, 1e300, 0x1.fffffffffffffp1023, kInfinity};
    on_every_target([&] {
        Random random(6);
        const auto size = [&] { return sizes[random.index(sizes.size())]; };
        const auto hard = [&] { return random.sign() * size(); };
        const auto bits_of = [](const Point3& p) { return std::bit_cast<std::array<std::uint64_t, 3>>(p); };
        shade::Paths paths;
        Vertices v;
        v.count = kShaded;
        Row survival, zero = {};
        std::fill_n(survival, kShaded, 1.0);
        const auto next = std::make_unique<shade::Segments>();
        std::size_t wrong = 0, usable = 0;
        for (int round = 0; round < 2000; ++round) {
            std::array<Ray, kShaded> alone;
            for (std::size_t i = 0; i < kShaded; ++i) {
                Surface s;
                s.position = {hard(), hard(), hard()};
                s.position_error = {size(), size(), size()};
                s.normal = {size(), hard(), hard()};  // not three times -0
                alone[i] = s.spawn_ray({hard(), hard(), hard()}, 0);
                v.position.set(i, s.position), v.position_error.set(i, s.position_error);
                v.normal.set(i, s.normal), v.direction.set(i, alone[i].direction);
            }
            next->count = 0;
            shade::add_segments(paths, v, true, survival, zero, zero, *next);
            std::size_t row = 0;
            for (const Ray& ray : alone)
                if (is_usable(ray)) wrong += bits_of(next->origin.get<Point3>(row++)) != bits_of(ray.origin);
            wrong += row != next->count, usable += row;
        }
        CHECK(wrong == 0);
        CHECK(usable > 2000);
    });
}

TEST_CASE("Lobes: light arrives weighed, along the ray from surface to lamp", "[render][lights][lobes]") {
    const std::vector<MaterialPtr> matte{grey(0.7), std::make_shared<Lambertian>(kAlbedo)},
        fog{std::make_shared<Isotropic>(kAlbedo)},
        metal{std::make_shared<Metal>(kAlbedo, 1), std::make_shared<Metal>(kAlbedo, 0.1)};
    const Compiled compiled(std::array{matte, fog, metal}[static_cast<std::size_t>(GENERATE(0, 1, 2))]);
    on_every_target([&] {
        Random random(7);
        std::size_t weights = 0, rays = 0, lit = 0;
        shade::Paths paths;
        const auto shadows = std::make_unique<shade::ShadowRays>();
        const auto samples = std::make_unique<lights::LightSamples>();
        for (int round = 0; round < 300; ++round) {
            Batch b(random, compiled);
            const flat::Light light = random_light(random);
            Row time = {}, odds = {};
            for (std::size_t i = 0; i < kShaded; ++i)
                samples->light[i] = &light, odds[i] = random.chance(0.5) ? 1 : random.uniform(0.1, 10);
            samples->numbers = b.vertices.numbers;
            lights::sample_points({kShaded, b.vertices.position, b.vertices.normal, time}, *samples);
            compiled.lobe().value(b.vertices, samples->direction);
            Rows3 emission;
            for (std::size_t i = 0; i < kShaded; ++i) emission.set(i, Color{5, 0.25, 1e-3});
            for (std::size_t i = 0; i < kShaded; ++i) {
                paths.path[i] = static_cast<std::uint32_t>(i);
                paths.throughput.set(i, Color{1, 0.5, 2});
            }
            shadows->count = 0;
            const auto counts = shade::add_shadow_rays(paths, b.vertices, *samples, emission, odds, *shadows);
            CHECK((counts.all == shadows->count && counts.unusable == 0));
            std::size_t row = 0;
            for (std::size_t i = 0; i < kShaded; ++i) {
                const auto alone =
                    sample_point(light, b.surfaces[i].position, b.vertices.numbers[1][i], b.vertices.numbers[2][i]);
                const ScatterValue f = alone ? compiled.materials[b.surfaces[i].material.id]->value(
                                                   b.surfaces[i], b.outs[i], alone->direction)
                                             : ScatterValue{};
                if (is_black(f.value)) continue;
                ++lit;
                weights += row >= shadows->count || shadows->path[row] != i;
                const Color arriving = shadows->light.get<Color>(row);
                const double a = odds[i] * alone->pdf, weight = a * a / (a * a + f.pdf * f.pdf) / alone->pdf;
                weights += !(std::abs(arriving.r - weight * 5 * f.value.r) <= 1e-13 * arriving.r &&
                             std::abs(arriving.b - 2 * weight * 1e-3 * f.value.b) <= 1e-13 * arriving.b);
                const Ray ray = b.surfaces[i].spawn_ray_to(alone->point, 0);
                rays += ray.origin != shadows->origin.get<Point3>(row) ||
                        ray.direction != shadows->direction.get<Vec3>(row);
                ++row;
            }
            weights += row != shadows->count;
        }
        CHECK(weights == 0);
        CHECK(rays == 0);
        CHECK(lit > 200);
    });
}

}  // namespace limn::lobes_test
