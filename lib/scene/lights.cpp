#include "scene/lights.h"

#include <string>

#include "limn/math/math.h"
#include "math/require.h"

namespace limn {

namespace {

// These check a field of a light. Errors call it `name`.
void check_color(const Color& color, const char* name) {
    require(is_radiance(color), std::string(name) + " must be finite and not negative");
}
void check_position(const Point3& position, const char* name) {
    require(is_finite(position - Point3{}), std::string(name) + " must be finite");
}
void check_direction(const Vec3& direction, const char* name) {
    require(is_finite(normalize(direction)), std::string(name) + " must be finite and not zero");
}

// Check all fields of a light.
void check_fields(const PointLight& light) {
    check_color(light.intensity, "PointLight: intensity");
    check_position(light.position, "PointLight: position");
}
void check_fields(const SpotLight& light) {
    check_color(light.intensity, "SpotLight: intensity");
    check_position(light.position, "SpotLight: position");
    check_direction(light.direction, "SpotLight: direction");
    const double inner = light.inner_cone_angle, outer = light.outer_cone_angle;
    require(inner >= 0 && inner <= outer && outer > 0 && outer <= 90,
            "SpotLight: the cone angles must be 0 <= inner_cone_angle <= outer_cone_angle, and that within (0, 90]");
}
void check_fields(const DirectionalLight& light) {
    check_color(light.irradiance, "DirectionalLight: irradiance");
    check_direction(light.direction, "DirectionalLight: direction");
}
void check_fields(const SunLight& light) {
    check_color(light.irradiance, "SunLight: irradiance");
    check_direction(light.direction, "SunLight: direction");
    require(light.angular_radius > 0 && light.angular_radius <= 90, "SunLight: angular_radius must lie within (0, 90]");
}

}  // namespace

void check(const LightSource& light) {
    std::visit([](const auto& kind) { check_fields(kind); }, light);
}

}  // namespace limn
