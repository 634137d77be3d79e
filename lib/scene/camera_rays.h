// Generates many rays of a camera at once.
#pragma once

#include <cstddef>

#include "limn/scene/camera.h"

namespace limn::camera {

// Rows with one number for each ray. Each row has space for one more vector, because whole vectors are read and
// written.
struct Rows {
    std::size_t count;
    const double* numbers[5];                 // input: the arguments of CameraRays::ray
    double *origin[3], *direction[3], *time;  // output
};

// Writes the same rays as CameraRays::ray() returns.
void make_rays(const CameraRays& camera, const Rows& rows);

}  // namespace limn::camera
