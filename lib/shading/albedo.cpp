#include "shading/albedo.h"

#include <memory>

#include "shading/shading.h"

namespace limn::shade {

namespace {

constexpr std::size_t kSamples = 16;

// Steps of a sequence that fills the unit cube evenly. They generalise the golden ratio (Roberts, The unreasonable
// effectiveness of quasirandom sequences, 2018).
constexpr double kSteps[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};

bsdf::Vertices& vertices_of_thread() {
    thread_local const auto vertices = std::make_unique<bsdf::Vertices>();  // too large for the stack
    return *vertices;
}

}  // namespace

Color albedo(const flat::Scene& scene, const Surface& surface) {
    const bsdf::Lobe* lobe = lobe_of(scene, surface.material);
    if (!lobe) return {};
    Surface flat = surface;
    flat.normal = flat.shading_normal;  // no direction is below the surface
    bsdf::Vertices& vertices = vertices_of_thread();
    vertices.count = kSamples;
    vertices.tangent_facets = 0;
    for (std::size_t i = 0; i < kSamples; ++i) {
        set_vertex(scene, flat, -Vec3(flat.normal), vertices, i);
        for (std::size_t d = 0; d < 3; ++d) {
            const double number = 0.5 + static_cast<double>(i) * kSteps[d];
            vertices.numbers[d][i] = number - std::floor(number);
        }
    }
    bsdf::sample(*lobe, vertices);
    Color sum;
    for (std::size_t i = 0; i < kSamples; ++i) sum += vertices.weight.get<Color>(i);
    return sum / static_cast<double>(kSamples);
}

}  // namespace limn::shade
