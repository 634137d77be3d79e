// The groups of rays that limn_accuracy measures.
#pragma once

#include <vector>

#include "accuracy/tally.h"

namespace limn::accuracy {

Group sphere_group(const Effort& effort);
Group triangle_group(const Effort& effort);
Group leak_group(const Effort& effort);
Group quad_group(const Effort& effort);
Group quad_leak_group(const Effort& effort);
Group slab_group(const Effort& effort);
Group instance_group(const Effort& effort);
Group leaving_group(const Effort& effort);
Group furnace_group(const Effort& effort);
Group bad_ray_group(const Effort& effort);
Group far_origin_group(const Effort& effort);
Group query_group(const Effort& effort);

}  // namespace limn::accuracy
