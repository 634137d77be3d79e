#include "bsdf/environment.h"

#include "bsdf/image_lookup.h"
#include "math/equirectangular-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::pattern {

Uv map_uv(const MapAxes& axes, const Vec3& direction) {
    const Vec3 d = normalize(direction);
    const auto at = sampling::HWY_NAMESPACE::map_point<double>({dot(d, axes.x), dot(d, axes.y), dot(d, axes.z)});
    return {at.right, 1 - at.down};
}

Color map_radiance(const Image& image, double scale, const Uv& uv) {
    return scale * lookup_image(image, uv, Filter::bilinear, Wrap::repeat, Wrap::clamp);
}

}  // namespace limn::pattern
HWY_AFTER_NAMESPACE();
