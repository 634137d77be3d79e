// The rays of a camera, many at once.
#pragma once

#include <cstddef>

#include "limn/scene/camera.h"

namespace limn::camera {

// One number for each ray, and room for those of a vector more.
struct Rows {
    std::size_t count;
    const double* numbers[5];  // the arguments of CameraRays::ray
    double *origin[3], *direction[3], *time;
};

// The same rays as those of CameraRays::ray.
void make_rays(const CameraRays& camera, const Rows& rows);

}  // namespace limn::camera
