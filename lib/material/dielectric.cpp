#include "limn/material/dielectric.h"

#include <cmath>

#include "bsdf/dielectric.h"
#include "core/require.h"

namespace limn {

Dielectric::Dielectric(double index, Fresnel fresnel) : index_(index), fresnel_(fresnel) {
    require(std::isfinite(index) && index > 0, "Dielectric: index must be positive and finite");
}

std::optional<ScatterSample> Dielectric::sample(const Surface& s, const Vec3& out, const Random3& random) const {
    return bsdf::sample_dielectric(index_, fresnel_, s, out, random);
}

MaterialRecord Dielectric::lower(RecordSink&) const {
    MaterialRecord record;
    record.kind = MaterialKind::dielectric;
    record.fresnel = fresnel_;
    record.parameter = index_;
    return record;
}

}  // namespace limn
