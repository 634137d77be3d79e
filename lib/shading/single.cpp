#include "shading/single.h"

#include <memory>

#include "math/heuristic-inl.h"
#include "math/spawn.h"
#include "shading/shading.h"

namespace limn::shade {

namespace {

// Returns rows of which the first is the vertex.
bsdf::Vertices rows_of(const flat::Scene& scene, const Surface& vertex, const Vec3& out) {
    bsdf::Vertices rows;
    rows.count = 1;
    set_vertex(scene, vertex, -out, rows, 0);
    return rows;
}

}  // namespace

Receiver receiver_at(const flat::Scene& scene, const Surface& vertex) {
    const bsdf::Lobe* lobe = lobe_of(scene, vertex.material);
    return {vertex.position, lobe && lobe->one_sided ? Vec3(vertex.normal) : Vec3{}};
}

std::optional<LightSample> sample_light(const flat::Scene& scene, const Surface& vertex, double time,
                                        const Random3& random) {
    const sampling::Row numbers[3] = {{random.x}, {random.y}, {random.z}};
    const auto samples = std::make_unique<lights::LightSamples>();
    samples->numbers = numbers;
    lights::sample(scene, OneReceiver(receiver_at(scene, vertex), time).rows(), *samples);
    if (!(samples->pdf[0] > 0)) return std::nullopt;
    // Make the shadow ray. A distant light has a direction, and other lights have a point.
    const Vec3 direction = samples->direction.get<Vec3>(0);
    Surface point;
    point.position = samples->position.get<Point3>(0);
    point.position_error = samples->position_error.get<Vec3>(0);
    point.normal = samples->normal.get<Normal3>(0);
    const bool is_distant = samples->end[0] == kInfinity;
    const Ray shadow_ray = is_distant ? leave(vertex, direction, time) : vertex.spawn_ray_to(point, time);
    return LightSample{direction, samples->pdf[0], radiance_of(scene, *samples, 0), shadow_ray};
}

double pdf_light(const flat::Scene& scene, const Receiver& receiver, double time, std::uint64_t primitive,
                 const Point3& position) {
    lights::LightHits hits;
    hits.primitive[0] = primitive;
    hits.position.set(0, position);
    lights::find_pdf(scene, OneReceiver(receiver, time).rows(), hits);
    return hits.pdf[0];
}

std::optional<ScatterSample> sample_material(const flat::Scene& scene, const Surface& vertex, const Vec3& out,
                                             const Random3& random) {
    const bsdf::Lobe* lobe = lobe_of(scene, vertex.material);
    if (!lobe) return std::nullopt;
    bsdf::Vertices v = rows_of(scene, vertex, out);
    v.numbers[0][0] = random.x;
    v.numbers[1][0] = random.y;
    v.numbers[2][0] = random.z;
    bsdf::sample(*lobe, v);
    if (is_black(v.weight.get<Color>(0))) return std::nullopt;
    return ScatterSample{v.direction.get<Vec3>(0), v.weight.get<Color>(0), v.pdf[0]};
}

ScatterValue material_value(const flat::Scene& scene, const Surface& vertex, const Vec3& out, const Vec3& in) {
    const bsdf::Lobe* lobe = lobe_of(scene, vertex.material);
    if (!lobe) return {};
    bsdf::Vertices v = rows_of(scene, vertex, out);
    sampling::Rows3 directions;
    directions.set(0, in);
    bsdf::value(*lobe, v, directions);
    return {v.value.get<Color>(0), v.value_pdf[0]};
}

double power_heuristic(double a, double b) { return sampling::HWY_NAMESPACE::power_heuristic(a, b); }

}  // namespace limn::shade
