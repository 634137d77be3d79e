#include "render/holes.h"

#include <algorithm>
#include <tuple>

#include "shading/shading.h"

namespace limn::transport {

double Holes::opacity_of(const flat::Scene& scene, const Ray& ray, const trace::Hit& hit) {
    const flat::Place place = flat::locate(scene, hit.primitive);
    const PrimitiveRange& range = scene.ranges[place.range];
    if (range.kind == PrimitiveKind::user_defined) return 1;
    const MaterialId material = flat::material_of(scene, range, place.element);
    if (material == MaterialId::none || !flat::has_holes(scene.materials[static_cast<std::size_t>(material)])) return 1;
    query::surface_at(scene, ray, hit, {true, scene.features.tangents}, met_);
    return shade::opacity(scene, met_.surface);
}

trace::Hit Holes::first_stop(const flat::Scene& scene, const Ray& ray, const trace::Hit& hit, double& number) {
    // A number that has decided one surface is uniform again between the ends that were left.
    const auto stops = [&](double opacity) {
        if (opacity == 1) return true;
        if (number < opacity) {
            number /= opacity;
            return true;
        }
        number = (number - opacity) / (1 - opacity);
        return false;
    };
    if (hit.primitive == flat::RawHit::kMiss || stops(opacity_of(scene, ray, hit))) return hit;
    crossings_.clear();
    trace::every_hit(scene, ray, crossings_);
    const auto order = [](const auto& a) { return std::tuple(a.t, a.primitive); };
    std::sort(crossings_.begin(), crossings_.end(), [&](const auto& a, const auto& b) { return order(a) < order(b); });
    for (const trace::Crossing& c : crossings_) {
        const trace::Hit next{{c.t, c.primitive}, c.u, c.v, c.index_matched};
        if (!(order(hit) < order(next)) || c.index_matched) continue;
        if (stops(opacity_of(scene, ray, next))) return next;
    }
    return {};
}

double Holes::transmittance(const flat::Scene& scene, const Ray& ray) {
    crossings_.clear();
    trace::every_hit(scene, ray, crossings_);
    double share = 1;
    for (const trace::Crossing& c : crossings_) {
        if (c.index_matched) continue;
        share *= 1 - opacity_of(scene, ray, {{c.t, c.primitive}, c.u, c.v, false});
        if (share == 0) break;
    }
    return share;
}

}  // namespace limn::transport
