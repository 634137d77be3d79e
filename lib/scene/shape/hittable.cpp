#include "limn/scene/shape/hittable.h"

#include "math/float_environment.h"

namespace limn {

namespace {

bool call_hit(const Hittable& object, const Ray& ray, UserDefinedHit& out) {
    const std::optional<Hit> hit = object.hit(ray);
    if (!hit) return false;
    out.t = hit->t;
    out.normal = hit->normal;
    out.shading_normal = hit->shading_normal;
    out.position_error = hit->position_error;
    out.u = hit->u;
    out.v = hit->v;
    out.uv = hit->uv.value_or(Uv{hit->u, hit->v});
    out.material = material_ref(hit->material);
    out.index_matched = hit->index_matched;
    return true;
}

}  // namespace

void Hittable::lower(RecordSink& sink) const {
    sink.identify(dynamic_cast<const Tagged*>(this));
    sink.user_defined({bounds(), this, &call_hit});
}

Box BuiltInShape::bounds() const {
    const FloatEnvironment environment;
    return box();
}

std::optional<Hit> BuiltInShape::hit(const Ray& ray) const {
    const FloatEnvironment environment;
    return is_usable(ray) ? intersect(ray) : std::nullopt;
}

}  // namespace limn
