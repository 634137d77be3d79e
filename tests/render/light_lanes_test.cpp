// Lights sampled together: the same as one by one, whatever the vectors and the rest of the batch.
#include <array>
#include <memory>

#include "catch.h"
#include "limn/limn.h"
#include "random_light.h"
#include "support/single_shading.h"
#include "support/targets.h"

namespace limn::light_lanes_test {

using namespace test;
using sampling::kShaded, sampling::Row, sampling::Rows3;

TEST_CASE("Lights: many receivers draw the light that each draws alone, on every instruction set",
          "[render][lights][determinism]") {
    Scene lit;
    lit.environment = std::make_shared<EnvironmentMap>(Image(4, 2, {1, 2, 3}), Transform::rotate_y(20));
    const CompiledScene compiled = compile(lit);
    const flat::EnvironmentLight environment{compiled.flat().environment.get()};
    std::vector<double> first;
    on_every_target([&] {
        Random random(6);
        std::vector<double> all;
        std::size_t wrong = 0;
        const auto samples = std::make_unique<lights::LightSamples>();
        for (int round = 0; round < 300; ++round) {
            std::array<flat::Light, kShaded> lights;
            Rows3 position, normal;
            Row time = {}, numbers[3] = {};
            for (std::size_t i = 0; i < kShaded; ++i) {
                lights[i] = i > 0 && random.chance(0.3) ? lights[i - 1] : random_light(random, environment);
                if (round % 8 == 0) lights[i] = lights[0];
                samples->light[i] = &lights[i];
                position.set(i, random.in_cube(2));
                for (auto& number : numbers) number[i] = random.chance(0.05) ? 0 : random.uniform();
            }
            samples->numbers = numbers;
            const std::size_t count = 1 + random.index(kShaded);
            const lights::Receivers receivers{count, position, normal, time};
            lights::sample_points(receivers, *samples);
            Rows3 places;
            for (std::size_t i = 0; i < count; ++i) {
                const bool distant = samples->end[i] == kInfinity;
                places.set(i, distant ? samples->direction.get<Vec3>(i) : samples->position.get<Vec3>(i));
            }
            Row pdf;
            lights::find_point_pdf(receivers, samples->light, places, pdf);
            for (std::size_t i = 0; i < count; ++i) {
                const auto alone = sample_point(lights[i], position.get<Point3>(i), numbers[1][i], numbers[2][i]);
                wrong += alone.has_value() != (samples->pdf[i] > 0);
                if (!alone) continue;
                const Point3 at = samples->position.get<Point3>(i), place = places.get<Point3>(i);
                wrong += alone->pdf != samples->pdf[i] || alone->direction != samples->direction.get<Vec3>(i) ||
                         alone->point.position != at || alone->point.normal != samples->normal.get<Normal3>(i);
                wrong += pdf_point(lights[i], position.get<Point3>(i), place) != pdf[i];
                for (const double x : {alone->pdf, pdf[i], place.x, place.y, place.z}) all.push_back(x);
            }
        }
        CHECK(wrong == 0);
        CHECK(all.size() > 5000);
        if (first.empty()) first = all;
        CHECK(all == first);
    });
}

TEST_CASE("Lights: many receivers at once choose the lights that each chooses alone", "[render][lights]") {
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
    const flat::LightTable& table = compiled.flat().lights;
    on_every_target([&] {
        std::size_t wrong = 0, none = 0;
        for (int round = 0; round < 300; ++round) {
            Rows3 position, normal;
            Row time = {}, pick = {}, rank = {}, probability = {};
            for (std::size_t i = 0; i < kShaded; ++i) {
                position.set(i, random.in_cube(2)), normal.set(i, random.chance(0.3) ? Vec3{} : random.unit());
                pick[i] = random.uniform(), rank[i] = static_cast<double>(random.index(table.size()));
            }
            std::array<lights::Choice, kShaded> together;
            const std::size_t some = 1 + random.index(kShaded);
            lights::choose(table, {some, position, normal, time}, pick, together.data());
            lights::find_probability(table, {some, position, normal, time}, rank, probability);
            for (std::size_t i = 0; i < some; ++i) {
                const Receiver receiver{position.get<Point3>(i), normal.get<Vec3>(i)};
                const auto alone = choose_light(table, receiver, pick[i]);
                none += !alone;
                wrong += alone ? alone->rank != together[i].rank || alone->probability != together[i].probability
                               : together[i].probability != 0;
                wrong += probability_of(table, receiver, static_cast<std::size_t>(rank[i])) != probability[i];
            }
        }
        CHECK(wrong == 0);
        CHECK((count < 3 || none > 0));
    });
}

}  // namespace limn::light_lanes_test
