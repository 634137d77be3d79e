#include "limn/scene/shape/disk.h"

#include "geometry/exact_disk.h"
#include "geometry/hit_error.h"
#include "scene/shape/arguments.h"

namespace limn {

Disk::Disk(const Point3& center, const Vec3& normal, double radius, std::shared_ptr<const Material> material)
    : center_(center), normal_(normal), radius_(radius), material_(std::move(material)) {
    require_finite(center, "Disk", "the center");
    require_finite(normal, "Disk", "the normal");
    if (normal == Vec3{}) throw ArgumentError("Disk: the normal must not be zero");
    if (!(radius > 0 && radius < kInfinity)) throw ArgumentError("Disk: the radius must be positive and finite");
}

Box Disk::box() const { return disk_bounds(center_, normal_, radius_); }

std::optional<Hit> Disk::intersect(const Ray& ray) const {
    PlanarHit hit;
    if (!intersect_disk(center_, normal_, radius_, frame_of(ray), {ray.t_min, ray.t_max}, hit)) return std::nullopt;
    const Vec3 edge{2 * radius_, 0, 0};
    return Hit{.t = hit.t,
               .normal = Normal3(normalize(normal_)),
               .u = hit.u,
               .v = hit.v,
               .material = material_.get(),
               .position_error = planar_error(center_, edge, edge)};
}

void Disk::lower(RecordSink& sink) const {
    sink.shape(PrimitiveKind::disk, &SceneRecords::disks,
               DiskRecord{center_, normal_, radius_, lower_material(sink, material_)});
}

}  // namespace limn
