#include "shading/lights.h"

#include <algorithm>

#include "shading/light_choice.h"
#include "shading/light_points.h"

namespace limn::lights {

void sample(const flat::Scene& scene, const Receivers& receivers, LightSamples& samples) {
    Choice choices[kShaded];
    choose(scene.lights, receivers, samples.numbers[0], choices);
    for (std::size_t i = 0; i < receivers.count; ++i)
        samples.light[i] = &flat::light_at(scene, choices[i].rank, receivers.time[i], samples.own[i]);
    sample_points(receivers, samples);
    for (std::size_t i = 0; i < receivers.count; ++i) samples.pdf[i] *= choices[i].probability;
}

void find_pdf(const flat::Scene& scene, const Receivers& receivers, LightHits& hits) {
    const auto& numbers = scene.lights.by_number;
    const flat::Light* lights[kShaded] = {};
    flat::Light own[kShaded];
    Row rank = {};
    for (std::size_t i = 0; i < receivers.count; ++i) {
        if (hits.primitive[i] >= flat::kFirstDistant) {
            const std::size_t place = hits.primitive[i] - flat::kFirstDistant;
            rank[i] = static_cast<double>(scene.lights.size() + place);
            lights[i] = &scene.lights.distant[place].light;
            continue;
        }
        const auto found = std::ranges::lower_bound(numbers, hits.primitive[i], {}, &flat::LightNumber::number);
        if (found == numbers.end() || found->number != hits.primitive[i]) continue;
        rank[i] = found->rank;
        lights[i] = &flat::light_at(scene, found->rank, receivers.time[i], own[i]);
    }
    find_point_pdf(receivers, lights, hits.position, hits.pdf);
    Row probability;
    find_probability(scene.lights, receivers, rank, probability);
    for (std::size_t i = 0; i < receivers.count; ++i) hits.pdf[i] *= lights[i] ? probability[i] : 0;
}

}  // namespace limn::lights
