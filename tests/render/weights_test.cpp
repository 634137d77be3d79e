// What is drawn towards lamps, and what it weighs, sample by sample.
#include "catch.h"
#include "render/path.h"
#include "support/pictures.h"
#include "support/single_shading.h"

namespace limn::weights_test {

using namespace test;

namespace {

// Veach, Robust Monte Carlo Methods for Light Transport Simulation, 1997, section 9.2.4.
double squares(double a, double b) { return a * a / (a * a + b * b); }

}  // namespace

TEST_CASE("Estimators: a lamp's light is shared by the squares of the densities that find it", "[render][lights]") {
    constexpr double kAlbedo = 0.6, kRadiance = 7;
    const CompiledScene scene = compile_with(sky(0), {quad({-50, 0, -50}, {0, 0, 100}, {100, 0, 0}, grey(kAlbedo)),
                                                      quad({-1, 1.2, -1}, {2, 0, 0}, {0, 0, 2}, lamp(kRadiance))});
    const Ray eye{{0, 1, 0}, {0, -1, 0}};
    const Surface floor = scene.surface_at(eye, scene.closest_hit(eye).value());
    const Vec3 out{0, 1, 0};
    const Receiver receiver{floor.position, Vec3(floor.normal)};
    transport::PathTracer tracer(scene.flat(), 2, Estimator::path);
    int found = 0;
    for (std::uint64_t i = 0; i < 100; ++i) {
        const transport::Sampler numbers(1, 2, i);
        const auto numbers_for = [&](transport::Use use) {
            const auto drawn = numbers.numbers_of(transport::Sampler::group_of(1, use));
            return Random3{drawn[0], drawn[1], drawn[2]};
        };
        const Random3 pick = numbers_for(transport::Use::light);
        const auto drawn = sample_light(scene.flat(), receiver, 0, pick.x, pick.y, pick.z);
        REQUIRE(drawn.has_value());
        const ScatterValue f = material_value(scene.flat(), floor, out, drawn->direction);
        double expected = f.value.r * kRadiance * squares(drawn->pdf, f.pdf) / drawn->pdf;

        const auto scattered = sample_material(scene.flat(), floor, out, numbers_for(transport::Use::scattering));
        REQUIRE(scattered.has_value());
        const Ray ray = floor.spawn_ray(scattered->direction, 0);
        if (const auto hit = scene.closest_hit(ray)) {
            const double pdf =
                pdf_light(scene.flat(), receiver, 0, hit->primitive, scene.surface_at(ray, *hit).position);
            expected += kAlbedo * kRadiance * squares(scattered->pdf, pdf);
            ++found;
        }
        CHECK(tracer.radiance(eye, numbers).r == Approx(expected).epsilon(1e-12));
    }
    CHECK(found > 0);
    CHECK(found < 100);
}

TEST_CASE("Lamps: a ball in a scaled instance is sampled like the scaled ball", "[render][lights]") {
    const CompiledScene plain = compile_with(sky(0), {sphere({0, 6, 0}, 3, lamp(1))});
    const CompiledScene scaled =
        compile_with(sky(0), {std::make_shared<Instance>(sphere({0, 2, 0}, 1, lamp(1)), Transform::scale(3, 3, 3))});
    for (const double u : {0.0, 0.3, 0.9})
        for (const double v : {0.0, 0.2, 0.7}) {
            const auto a = sample_light(plain.flat(), {}, 0, 0.5, u, v);
            const auto b = sample_light(scaled.flat(), {}, 0, 0.5, u, v);
            REQUIRE((a && b));
            CHECK(b->pdf == Approx(a->pdf).epsilon(1e-13));
            CHECK(length(b->point.position - a->point.position) <= 1e-13);
        }
}

}  // namespace limn::weights_test
