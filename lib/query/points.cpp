// Implements the queries of points of CompiledScene: locate, contains, closest_point and signed_distance.
#include <cmath>

#include "limn/math/error.h"
#include "limn/query/compiled_scene.h"
#include "query/batches.h"
#include "trace/closest_point.h"

namespace limn {

namespace {

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

Feature feature_of(NearestPoint::Part part) {
    using Part = NearestPoint::Part;
    if (part == Part::face) return Feature::face;
    return part == Part::a || part == Part::b || part == Part::c ? Feature::vertex : Feature::edge;
}

// Sets results[i] to answer(points[i]) for each point.
// \throws ArgumentError as check_length() and for_all_parts() do
template <class Result, class Answer>
void answer_points(std::span<const Point3> points, std::span<Result> results, int threads, const char* who,
                   const char* names, const Answer& answer) {
    query::check_length(points.size(), results.size(), who, names);
    query::for_all_parts(points.size(), threads, who, [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) results[i] = static_cast<Result>(answer(points[i]));
    });
}

}  // namespace

PointLocation CompiledScene::locate(const Point3& point, double time) const {
    return query::ask(*this, [&](const flat::Scene& scene) -> PointLocation {
        const Vec3 direction = way_out(flat::blas_at(scene, BlasId::root).bounds, point);
        const Ray ray{.origin = point, .direction = direction, .time = time};
        if (!query::is_fit(ray)) return {};
        const trace::PassageCount found = trace::passages(scene, ray, true, nullptr);
        return {
            .winding_number = found.outward, .on_surface = found.touched != kNoPrimitive, .primitive = found.touched};
    });
}

bool CompiledScene::contains(const Point3& point, double time) const { return locate(point, time).is_inside(); }

std::optional<ClosestPoint> CompiledScene::closest_point(const Point3& point, double max_distance, double time) const {
    return query::ask(*this, [&](const flat::Scene& scene) -> std::optional<ClosestPoint> {
        if (scene.features.user_defined_shapes)
            throw ArgumentError("closest_point: the scene has user-defined shapes, which only rays can query");
        if (!is_finite(point) || !(max_distance >= 0) || !std::isfinite(time)) return std::nullopt;
        const trace::NearestSurface found = trace::closest_point(scene, point, max_distance, time);
        if (found.primitive == kNoPrimitive) return std::nullopt;
        const std::size_t object = flat::object_of(scene, found.primitive);
        return ClosestPoint{.distance = found.distance,
                            .position = found.position,
                            .feature = feature_of(found.point.part),
                            .object = static_cast<std::uint32_t>(object),
                            .element = found.primitive - scene.first_of_object[object],
                            .u = found.point.u,
                            .v = found.point.v,
                            .index_matched = flat::locate(scene, found.primitive).index_matched,
                            .primitive = found.primitive};
    });
}

double CompiledScene::signed_distance(const Point3& point, double time) const {
    const std::optional<ClosestPoint> nearest = closest_point(point, kInfinity, time);
    if (!nearest) return kInfinity;
    const PointLocation location = locate(point, time);
    if (location.on_surface) return 0;
    return location.winding_number != 0 ? -nearest->distance : nearest->distance;
}

void CompiledScene::locate(std::span<const Point3> points, std::span<PointLocation> locations, int threads) const {
    answer_points(points, locations, threads, "locate", "points and locations",
                  [&](const Point3& p) { return locate(p); });
}

void CompiledScene::contains(std::span<const Point3> points, std::span<std::uint8_t> inside, int threads) const {
    answer_points(points, inside, threads, "contains", "points and inside",
                  [&](const Point3& p) { return contains(p) ? 1 : 0; });
}

void CompiledScene::closest_point(std::span<const Point3> points, std::span<ClosestPoint> nearest, int threads) const {
    answer_points(points, nearest, threads, "closest_point", "points and nearest",
                  [&](const Point3& p) { return closest_point(p).value_or(ClosestPoint{}); });
}

void CompiledScene::signed_distance(std::span<const Point3> points, std::span<double> distances, int threads) const {
    answer_points(points, distances, threads, "signed_distance", "points and distances",
                  [&](const Point3& p) { return signed_distance(p); });
}

}  // namespace limn
