// Implements CompiledScene::closest_point and signed_distance.
#include <cmath>

#include "limn/math/error.h"
#include "limn/query/compiled_scene.h"
#include "math/float_environment.h"
#include "query/results.h"
#include "trace/closest_point.h"

namespace limn {

namespace {

Feature feature_of(NearestPoint::Part part) {
    using Part = NearestPoint::Part;
    if (part == Part::face) return Feature::face;
    return part == Part::a || part == Part::b || part == Part::c ? Feature::vertex : Feature::edge;
}

}  // namespace

std::optional<ClosestPoint> CompiledScene::closest_point(const Point3& point, double max_distance, double time) const {
    const FloatEnvironment environment;
    if (scene_->features.user_defined_shapes)
        throw ArgumentError("closest_point: the scene has user-defined shapes, which only rays can query");
    if (!is_finite(point) || !(max_distance >= 0) || !std::isfinite(time)) return std::nullopt;
    const trace::NearestSurface found = trace::closest_point(*scene_, point, max_distance, time);
    if (found.primitive == kNoPrimitive) return std::nullopt;
    const std::size_t object = flat::object_of(*scene_, found.primitive);
    return ClosestPoint{.distance = found.distance,
                        .position = found.position,
                        .feature = feature_of(found.point.part),
                        .object = static_cast<std::uint32_t>(object),
                        .element = found.primitive - scene_->first_of_object[object],
                        .u = found.point.u,
                        .v = found.point.v,
                        .index_matched = flat::locate(*scene_, found.primitive).index_matched,
                        .primitive = found.primitive};
}

double CompiledScene::signed_distance(const Point3& point, double time) const {
    const std::optional<ClosestPoint> nearest = closest_point(point, kInfinity, time);
    if (!nearest) return kInfinity;
    const PointLocation location = locate(point, time);
    if (location.on_surface) return 0;
    return location.winding_number != 0 ? -nearest->distance : nearest->distance;
}

}  // namespace limn
