// A ray seen from inside an instance, one definition for the described and the compiled world.
#pragma once

#include "limn/core/ray.h"
#include "limn/core/transform.h"

namespace limn {

// The translation is subtracted first, where it cancels best. The direction keeps its length, so that t means the same
// on both sides.
inline Ray to_object_ray(const Transform& world_from_object, const Transform& object_from_world, const Ray& ray) {
    Ray local = ray;
    local.origin =
        Point3{} + transform_vector(object_from_world, (ray.origin - Point3{}) - world_from_object.translation());
    local.direction = transform_vector(object_from_world, ray.direction);
    return local;
}

}  // namespace limn
