#include "limn/math/frame.h"

#include "math/warps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn {

namespace {

Vec3 vec3(const HWY_NAMESPACE::Vector<double>& v) { return {v.x, v.y, v.z}; }

}  // namespace

Frame::Frame(const Vec3& n) : z(n) {
    const sampling::HWY_NAMESPACE::Basis<double> basis({n.x, n.y, n.z});
    x = vec3(basis.x);
    y = vec3(basis.y);
}

}  // namespace limn
HWY_AFTER_NAMESPACE();
