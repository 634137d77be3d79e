#include "scene/lights.h"

#include <cmath>

#include "limn/math/math.h"
#include "math/elementary.h"
#include "math/require.h"

namespace limn {

namespace {

// Checks a light and returns its record.
struct Describe {
    LightRecord operator()(const PointLight& light) const {
        LightRecord record = of(LightSourceKind::point, light.intensity, "PointLight: intensity");
        record.position = checked(light.position, "PointLight: position");
        return record;
    }
    LightRecord operator()(const SpotLight& light) const {
        LightRecord record = of(LightSourceKind::spot, light.intensity, "SpotLight: intensity");
        record.position = checked(light.position, "SpotLight: position");
        record.direction = unit(light.direction, "SpotLight: direction");
        const double inner = light.inner_cone_angle, outer = light.outer_cone_angle;
        require(
            inner >= 0 && inner <= outer && outer > 0 && outer <= 90,
            "SpotLight: the cone angles must be 0 <= inner_cone_angle <= outer_cone_angle, and that within (0, 90]");
        record.cos_inner = cosine(radians(inner));
        record.cos_outer = cosine(radians(outer));
        return record;
    }
    LightRecord operator()(const DirectionalLight& light) const {
        LightRecord record = of(LightSourceKind::directional, light.irradiance, "DirectionalLight: irradiance");
        record.direction = unit(light.direction, "DirectionalLight: direction");
        return record;
    }
    LightRecord operator()(const SunLight& light) const {
        LightRecord record = of(LightSourceKind::sun, light.irradiance, "SunLight: irradiance");
        record.direction = unit(light.direction, "SunLight: direction");
        require(light.angular_radius > 0 && light.angular_radius <= 90,
                "SunLight: angular_radius must lie within (0, 90]");
        const double half_sine = sine(radians(light.angular_radius) / 2);
        record.one_minus_cos = 2 * half_sine * half_sine;
        return record;
    }

private:
    // Returns a record with this colour, which `name` names in errors.
    static LightRecord of(LightSourceKind kind, const Color& color, const char* name) {
        require(is_radiance(color), std::string(name) + " must be finite and not negative");
        LightRecord record;
        record.kind = kind;
        record.color = color;
        return record;
    }
    static Point3 checked(const Point3& p, const char* name) {
        require(is_finite(p - Point3{}), std::string(name) + " must be finite");
        return p;
    }
    static Vec3 unit(const Vec3& v, const char* name) {
        const Vec3 direction = normalize(v);
        require(is_finite(direction), std::string(name) + " must be finite and not zero");
        return direction;
    }
};

}  // namespace

LightRecord record_of(const LightSource& light) { return std::visit(Describe{}, light); }

}  // namespace limn
