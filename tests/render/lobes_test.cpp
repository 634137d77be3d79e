// Vertices shaded side by side: the same as one by one, whatever the vectors and the company.
#include "shade/lobes.h"

#include <array>

#include "bsdf/dielectric.h"
#include "bsdf/isotropic.h"
#include "bsdf/lambertian.h"
#include "catch.h"
#include "core/spawn.h"
#include "limn/limn.h"
#include "render/direct_light.h"
#include "render/light_sampling.h"
#include "render/sampler.h"
#include "support/random_geometry.h"
#include "trace/targets.h"

using namespace limn;
using namespace limn::test;
using flat::Light;
using flat::LightKind;
using sampling::kShaded;
using shade::Lobe;
using shade::VertexLanes;
using transport::Sampler;

namespace {

// Runs check(name) on each instruction set that this processor has, and goes back to the best.
template <class Check>
void on_every_target(const Check& check) {
    const std::vector<std::string> names = trace::targets();
    for (const std::string& name : names) {
        REQUIRE(trace::force_target(name));
        INFO(name);
        check();
    }
    trace::force_target(names.front());
}

Light random_light(Random& random) {
    Light light;
    const double size = random.log_uniform(1e-3, 30);
    light.kind = std::array{LightKind::triangle, LightKind::parallelogram, LightKind::rectangle,
                            LightKind::sphere}[random.index(4)];
    light.origin = Point3{} + random.in_cube(3);
    if (light.kind == LightKind::sphere) {
        light.radius = size;
        return light;
    }
    light.edge_u = size * random.unit();
    light.edge_v = size * random.unit();
    if (light.kind == LightKind::rectangle)
        light.edge_v = random.log_uniform(0.1, 10) * cross(light.edge_u, random.unit());
    const double error = random.uniform(0, 1e-13);
    light.position_error = {error, error, error};
    return light;
}

struct Scenery {
    std::array<Light, kShaded> lights;
    VertexLanes lanes;

    Scenery(Random& random, Lobe lobe) {
        lanes.count = kShaded;
        for (std::size_t i = 0; i < kShaded; ++i) {
            const bool inside = lobe == Lobe::isotropic;
            const Vec3 normal = inside ? Vec3{} : random.chance(0.1) ? Vec3{0, 0, random.sign()} : random.unit();
            const Vec3 leaning = inside ? Vec3{} : normalize(normal + 0.3 * random.in_cube());
            lanes.position.set(i, random.chance(0.1) ? Vec3{0, 1, -2} : random.in_cube(2));
            lanes.position_error.set(i, random.chance(0.1) ? Vec3{} : random.log_uniform(1e-18, 1e-6) * Vec3{1, 1, 1});
            lanes.normal.set(i, normal);
            lanes.shading_normal.set(i, random.chance(0.5) ? leaning : normal);
            lanes.albedo.set(i, Color{random.uniform(), random.uniform(), random.uniform()});
            lanes.emission.set(i, Color{5, random.uniform(), 1e-3});
            lanes.out.set(i, random.unit());
            lanes.eta[i] = random.chance(0.05) ? 1 : random.uniform(0.4, 2.5);
            lanes.exact_fresnel[i] = random.chance(0.5) ? 1 : 0;
            lights[i] = i > 0 && random.chance(0.3) ? lights[i - 1] : random_light(random);
            lanes.light[i] = &lights[i];
            lanes.probability[i] = random.chance(0.1) ? 0 : random.uniform(0.01, 1);
            for (auto& number : lanes.numbers) number[i] = random.chance(0.05) ? 0 : random.uniform();
        }
    }
    Surface surface(std::size_t i) const {
        Surface s;
        s.position = lanes.position.get<Point3>(i), s.position_error = lanes.position_error.get<Vec3>(i);
        s.normal = lanes.normal.get<Normal3>(i), s.shading_normal = lanes.shading_normal.get<Normal3>(i);
        return s;
    }
    ScatterValue value(Lobe lobe, std::size_t i, const Vec3& in) const {
        const Color albedo = lanes.albedo.get<Color>(i);
        return lobe == Lobe::lambertian  ? bsdf::value_lambertian(albedo, surface(i), {}, in)
               : lobe == Lobe::isotropic ? bsdf::value_isotropic(albedo)
                                         : ScatterValue{};
    }
    std::optional<ScatterSample> sample(Lobe lobe, std::size_t i) const {
        const Random3 r{lanes.numbers[0][i], lanes.numbers[1][i], 0};
        const Color albedo = lanes.albedo.get<Color>(i);
        switch (lobe) {
            case Lobe::lambertian: return bsdf::sample_lambertian(albedo, surface(i), {}, r);
            case Lobe::isotropic: return bsdf::sample_isotropic(albedo, r);
            case Lobe::dielectric: break;
        }
        Surface at = surface(i);
        at.front_face = true;
        const Fresnel fresnel = lanes.exact_fresnel[i] > 0 ? Fresnel::exact : Fresnel::schlick;
        return bsdf::sample_dielectric(lanes.eta[i], fresnel, at, lanes.out.get<Vec3>(i), r);
    }
};

bool are_close(double a, double b, double tolerance) { return std::abs(a - b) <= tolerance * (std::abs(a) + 1e-300); }

// What lane i got, to the bit.
std::array<double, 20> answers(const VertexLanes& v, std::size_t i) {
    const auto bit = [i](std::uint32_t bits) { return static_cast<double>(bits >> i & 1); };
    const double lit = bit(v.lit);
    std::array<double, 20> all{v.pdf[i],         v.origin.x[i],    v.origin.y[i], v.origin.z[i], v.direction.x[i],
                               v.direction.y[i], v.direction.z[i], lit,           bit(v.open)};
    std::size_t n = 10;
    if (lit == 0) return all;
    for (const shade::Lanes3* three : {&v.arriving, &v.shadow_origin, &v.shadow_direction})
        for (const double x : {three->x[i], three->y[i], three->z[i]}) all[n++] = x;
    return all;
}

void shade_vertices(Lobe lobe, VertexLanes& lanes) {
    shade::scatter(lobe, lanes);
    if (lobe != Lobe::dielectric) shade::sample_lights(lobe, lanes);
}

}  // namespace

TEST_CASE("Lobes: many samplers at once draw what each draws alone", "[render][sampler][lobes]") {
    const SamplerKind kind = GENERATE(SamplerKind::sobol, SamplerKind::independent);
    on_every_target([kind] {
        std::size_t wrong = 0;
        sampling::SobolLanes room;
        sampling::Lane numbers[5];
        for (std::uint64_t round = 0; round < 40; ++round) {
            std::vector<Sampler> samplers;
            const std::size_t count = round < kShaded ? round + 1 : kShaded;
            for (std::uint64_t i = 0; i < count; ++i) {
                samplers.emplace_back(round, i, (i * i + round) << (i % 24), kind);
                samplers.back().seek(static_cast<int>(i % 7), static_cast<transport::Use>(i % 4));
            }
            std::vector<Sampler> alone = samplers;
            const auto at = [&](std::size_t i) -> Sampler& { return samplers[i]; };
            const auto differ = [&](std::size_t i, const auto& drawn) {
                for (std::size_t d = 0; d < drawn.size(); ++d) wrong += drawn[d] != numbers[d][i];
            };
            Sampler::draw_many<5>(count, at, room, numbers);
            for (std::size_t i = 0; i < count; ++i) differ(i, alone[i].next_5d());
            Sampler::draw_many<3>(count, at, room, numbers);
            for (std::size_t i = 0; i < count; ++i) {
                const Random3 r = alone[i].next_3d();
                differ(i, std::array{r.x, r.y, r.z});
            }
            Sampler::draw_many<2>(count, at, room, numbers);
            for (std::size_t i = 0; i < count; ++i) {
                const Uv r = alone[i].next_2d();
                differ(i, std::array{r.u, r.v});
            }
            Sampler::draw_many<1>(count, at, room, numbers);
            for (std::size_t i = 0; i < count; ++i) differ(i, std::array{alone[i].next()});
        }
        CHECK(wrong == 0);
    });
}

TEST_CASE("Lobes: vertices scatter as their materials do", "[render][shading][lobes]") {
    const Lobe lobe = GENERATE(Lobe::lambertian, Lobe::isotropic, Lobe::dielectric);
    on_every_target([lobe] {
        Random random(5);
        std::size_t directions = 0, densities = 0, origins = 0, absorbed = 0;
        for (int round = 0; round < 2000; ++round) {
            Scenery s(random, lobe);
            shade::scatter(lobe, s.lanes);
            for (std::size_t i = 0; i < kShaded; ++i) {
                const auto alone = s.sample(lobe, i);
                const Vec3 in = s.lanes.direction.get<Vec3>(i);
                const double pdf = s.value(lobe, i, in).pdf;
                const bool scattered = s.lanes.scattered >> i & 1;
                densities += !are_close(pdf, s.lanes.pdf[i], 1e-15);
                absorbed += !scattered;
                origins += leave(s.surface(i), in, 0).origin != s.lanes.origin.get<Point3>(i);
                if (lobe == Lobe::dielectric) {
                    directions += scattered != alone.has_value() || (alone && alone->direction != in);
                    continue;
                }
                // The height over the disc loses digits at its rim, and there rounding decides what is above.
                const double tolerance = 2e-15 / std::max(kPi * pdf, 1e-8);
                directions += alone ? !(max_abs(alone->direction - in) <= tolerance) : pdf > 1e-8;
            }
        }
        CHECK(directions == 0);
        CHECK(densities == 0);
        CHECK(origins == 0);
        CHECK((lobe == Lobe::isotropic || absorbed > 100));
    });
}

TEST_CASE("Lobes: vertices draw light as one by one, or leave it to that", "[render][lights][lobes]") {
    const Lobe lobe = GENERATE(Lobe::lambertian, Lobe::isotropic);
    on_every_target([lobe] {
        Random random(6);
        const flat::Scene none;
        std::size_t lights = 0, rays = 0, missing = 0, left = 0, lit = 0, dark = 0;
        for (int round = 0; round < 2000; ++round) {
            Scenery s(random, lobe);
            shade::sample_lights(lobe, s.lanes);
            for (std::size_t i = 0; i < kShaded; ++i) {
                const VertexLanes& v = s.lanes;
                const bool is_lit = v.lit >> i & 1, is_open = v.open >> i & 1;
                if (v.probability[i] == 0) {
                    missing += is_lit || is_open;
                    continue;
                }
                const Light& light = s.lights[i];
                if (is_open) {
                    left += light.kind == LightKind::rectangle || light.kind == LightKind::sphere;
                    continue;
                }
                const Surface at = s.surface(i);
                const auto drawn = transport::sample_chosen_light(none, light, v.probability[i], {at.position, {}}, 0,
                                                                  v.numbers[1][i], v.numbers[2][i]);
                const ScatterValue f = drawn ? s.value(lobe, i, drawn->direction) : ScatterValue{};
                if (is_lit != !is_black(f.value)) {
                    missing += f.pdf > 1e-9;
                    continue;
                }
                ++(is_lit ? lit : dark);
                if (!is_lit) continue;
                const double weight = transport::power_heuristic(drawn->pdf, f.pdf) / drawn->pdf;
                const Color wanted = f.value * v.emission.get<Color>(i) * weight;
                // A cosine near 0 has lost digits; so has a place on a light seen almost edge-on, or at its rim.
                const double tolerance = 1e-9 + 1e-13 / f.pdf;
                lights += !(are_close(wanted.r, v.arriving.x[i], tolerance) &&
                            are_close(wanted.g, v.arriving.y[i], tolerance) &&
                            are_close(wanted.b, v.arriving.z[i], tolerance));
                const Ray shadow = leave_for(at, drawn->point, 0);
                const double far = max_abs(shadow.direction) + max_abs(shadow.origin);
                rays += !(max_abs(shadow.origin - v.shadow_origin.get<Point3>(i)) <= 1e-9 * far &&
                          max_abs(shadow.direction - v.shadow_direction.get<Vec3>(i)) <= 1e-7 * far);
            }
        }
        CHECK(lights == 0);
        CHECK(rays == 0);
        CHECK(missing == 0);
        CHECK(left == 0);
        CHECK(lit > 5000);
        CHECK((lobe == Lobe::isotropic || dark > 5000));
    });
}

TEST_CASE("Lobes: a vertex gets the same bits alone, in any company and on any instruction set",
          "[render][determinism][lobes]") {
    const Lobe lobe = GENERATE(Lobe::lambertian, Lobe::isotropic, Lobe::dielectric);
    std::vector<std::array<double, 20>> first;
    on_every_target([&] {
        Random random(7);
        std::vector<std::array<double, 20>> together;
        std::size_t differing = 0;
        for (int round = 0; round < 200; ++round) {
            Scenery s(random, lobe);
            VertexLanes alone = s.lanes;
            shade_vertices(lobe, s.lanes);
            for (std::size_t i = 0; i < kShaded; ++i) together.push_back(answers(s.lanes, i));
            // In the first lane, on their own.
            alone.count = 1;
            const std::size_t at = random.index(kShaded);
            alone.eta[0] = alone.eta[at], alone.exact_fresnel[0] = alone.exact_fresnel[at];
            for (shade::Lanes3* three : {&alone.out, &alone.position, &alone.position_error, &alone.normal,
                                         &alone.shading_normal, &alone.albedo, &alone.emission})
                three->set(0, three->get<Vec3>(at));
            for (auto& number : alone.numbers) number[0] = number[at];
            alone.light[0] = alone.light[at], alone.probability[0] = alone.probability[at];
            shade_vertices(lobe, alone);
            differing += answers(alone, 0) != answers(s.lanes, at);
        }
        CHECK(differing == 0);
        if (first.empty()) first = together;
        CHECK(together == first);
    });
}

TEST_CASE("Lobes: many vertices at once choose the lights that each chooses alone", "[render][lights][lobes]") {
    const Lobe lobe = GENERATE(Lobe::lambertian, Lobe::isotropic);
    const int count = GENERATE(1, 2, 3, 40);
    Random random(8);
    Scene scene;
    for (int i = 0; i < count; ++i) {
        const auto lamp = std::make_shared<DiffuseLight>(Color{1, 1, 1});
        const Point3 at = Point3{} + random.in_cube(2);
        if (random.chance(0.3)) {
            scene.add(std::make_shared<Sphere>(at, 0.1, lamp));
        } else {
            scene.add(std::make_shared<Quad>(at, 0.2 * random.unit(), 0.2 * random.unit(), lamp));
        }
    }
    const CompiledScene compiled = compile(scene);
    const flat::LightTable& lights = compiled.flat().lights;
    on_every_target([&] {
        std::size_t wrong = 0, none = 0;
        for (int round = 0; round < 300; ++round) {
            Scenery s(random, lobe);
            s.lanes.count = 1 + random.index(kShaded);
            std::array<transport::LightChoice, kShaded> together;
            transport::choose_lights(lights, lobe, s.lanes, together.data());
            for (std::size_t i = 0; i < s.lanes.count; ++i) {
                const transport::Receiver receiver{s.lanes.position.get<Point3>(i), s.lanes.normal.get<Vec3>(i)};
                const auto alone = transport::choose_light(lights, receiver, s.lanes.numbers[0][i]);
                none += !alone;
                wrong += alone ? alone->rank != together[i].rank || alone->probability != together[i].probability
                               : together[i].probability != 0;
            }
        }
        CHECK(wrong == 0);
        CHECK((lobe == Lobe::isotropic || count != 2 || none > 0));
    });
}
