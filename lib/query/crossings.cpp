// Implements crossings, count_intersections, winding_number, locate and contains of CompiledScene. All of them follow
// from the passages of a ray through surfaces (geometry/passage.h).
#include <cmath>
#include <vector>

#include "limn/query/compiled_scene.h"
#include "math/float_environment.h"
#include "query/filters.h"
#include "query/results.h"

namespace limn {

namespace {

// Sorts `found` along the ray and appends it to `crossings`.
void list(const flat::Scene& scene, std::vector<trace::Crossing>& found, std::vector<RayCrossing>& crossings) {
    query::sort_along_ray(found);
    crossings.reserve(found.size());
    for (const trace::Crossing& c : found) crossings.push_back({query::complete(scene, c), c.inward});
}

// Counts the passages of a ray; an unusable ray has none. If `wants_touched` is true, the surface that the ray's origin
// is exactly on is looked for too.
trace::PassageCount count(const flat::Scene& scene, const Ray& ray, bool wants_touched) {
    const FloatEnvironment environment;
    return query::is_fit(ray) ? trace::passages(scene, ray, wants_touched, nullptr) : trace::PassageCount{};
}

// Returns the direction of the ray that locate() counts passages along. For closed surfaces, every direction gives the
// same winding number. This one takes the shortest way out of the bounds, where a ray intersects the fewest surfaces.
// It is tilted a little against the axes, so that faces parallel to the axes do not need exact arithmetic.
Vec3 way_out(const Box& bounds, const Point3& p) {
    std::size_t axis = 0;
    double shortest = kInfinity, sign = 1;
    for (std::size_t a = 0; a < 3; ++a)
        for (const double s : {-1.0, 1.0}) {
            const double way = s < 0 ? p[a] - bounds.lower[a] : bounds.upper[a] - p[a];
            if (way < shortest) {
                shortest = way;
                axis = a;
                sign = s;
            }
        }
    Vec3 direction{0.0432751, -0.0791537, 0.0613921};
    direction[axis] = sign;
    return direction;
}

}  // namespace

void CompiledScene::crossings(const Ray& ray, std::vector<RayCrossing>& crossings) const {
    const FloatEnvironment environment;
    crossings.clear();
    if (!query::is_fit(ray)) return;
    query::Found found;
    trace::passages(*scene_, ray, false, &*found);
    list(*scene_, *found, crossings);
}

std::vector<RayCrossing> CompiledScene::crossings(const Ray& ray) const {
    std::vector<RayCrossing> list;
    crossings(ray, list);
    return list;
}

std::size_t CompiledScene::count_intersections(const Ray& ray) const {
    return static_cast<std::size_t>(count(*scene_, ray, false).count);
}

std::int64_t CompiledScene::winding_number(const Ray& ray) const { return count(*scene_, ray, false).outward; }

PointLocation CompiledScene::locate(const Point3& point, double time) const {
    const Vec3 direction = way_out(flat::blas_at(*scene_, BlasId::root).bounds, point);
    const trace::PassageCount found = count(*scene_, {.origin = point, .direction = direction, .time = time}, true);
    return {.winding_number = found.outward, .on_surface = found.touched != kNoPrimitive, .primitive = found.touched};
}

bool CompiledScene::contains(const Point3& point, double time) const { return locate(point, time).is_inside(); }

void CompiledScene::crossings(const Ray& ray, const RayFilter& filter, std::vector<RayCrossing>& crossings) const {
    const FloatEnvironment environment;
    const trace::Filter checked = query::checked(*scene_, filter, "crossings");
    crossings.clear();
    if (!query::is_fit(ray)) return;
    query::Found found;
    trace::passages(*scene_, ray, checked, &*found);
    list(*scene_, *found, crossings);
}

std::size_t CompiledScene::count_intersections(const Ray& ray, const RayFilter& filter) const {
    const FloatEnvironment environment;
    const trace::Filter checked = query::checked(*scene_, filter, "count_intersections");
    if (!query::is_fit(ray)) return 0;
    return static_cast<std::size_t>(trace::passages(*scene_, ray, checked, nullptr).count);
}

}  // namespace limn
