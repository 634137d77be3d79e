// Points on spheres, uniform per solid angle. The include guard is per target, as Highway requires.
#if defined(LIMN_SHADING_SPHERE_LIGHT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_SHADING_SPHERE_LIGHT_INL_H
#undef LIMN_SHADING_SPHERE_LIGHT_INL_H
#else
#define LIMN_SHADING_SPHERE_LIGHT_INL_H
#endif

#include "math/warps-inl.h"
#include "shading/light_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::lights::HWY_NAMESPACE {

// \pre the lights are where they are at the receivers' time, as light_at() returns them
template <>
struct InLanes<flat::SphereLight> {
    Vector<Doubles> center, position_error;
    Doubles radius, side;

    HWY_INLINE explicit InLanes(const LightsOf<flat::SphereLight>& of)
        : center(of(&flat::SphereLight::center)),
          position_error(of(&flat::SphereLight::position_error)),
          radius(of(&flat::SphereLight::radius)),
          side(of(&flat::SphereLight::side)) {}

    HWY_INLINE LightPoints sample(const Vector<Doubles>& from, Doubles u, Doubles v) const {
        // Sample a direction in the cone.
        const Cone cone(*this, from);
        const Vector<Doubles> local = uniform_cone(u, v, cone.one_minus_cos);
        LightPoints s;
        s.direction = select(cone.outside, Basis<Doubles>(normalize(cone.to_center)).to_world(local), local);
        // Find the point where the direction hits the sphere: go along it to the foot of the centre, then half a chord
        // back, or forward from inside. At the rim rounding may leave no chord.
        const Vector<Doubles> foot = dot(cone.to_center, s.direction) * s.direction - cone.to_center;
        const Doubles half_chord = sqrt(max(0.0, radius * radius - length_squared(foot)));
        const Vector<Doubles> normal = normalize(foot + select(cone.outside, -half_chord, half_chord) * s.direction);
        s.position = center + radius * normal;
        s.position_error = position_error;
        s.normal = select(cone.outside, normal, -normal);
        // Compute the pdf. It is 0 if the side that faces the receiver doesn't shine, or if the normal is NaN.
        const Mask<Doubles> shines = select(cone.outside, side, -side) >= 0.0;
        s.pdf = select(shines & (length_squared(normal) < 2.0), uniform_cone_pdf(cone.one_minus_cos), 0.0);
        return s;
    }

    HWY_INLINE Doubles pdf(const Vector<Doubles>& from, const Vector<Doubles>&) const {
        return uniform_cone_pdf(Cone(*this, from).one_minus_cos);
    }

private:
    // The cone in which a receiver sees the sphere. From inside the sphere it contains all directions.
    struct Cone {
        Vector<Doubles> to_center;
        Doubles one_minus_cos;
        Mask<Doubles> outside;

        HWY_INLINE Cone(const InLanes& light, const Vector<Doubles>& from) : to_center(light.center - from) {
            const Doubles sine2 = light.radius * light.radius / length_squared(to_center);
            outside = sine2 < 1.0;
            // 1 - cos would cancel for small spheres; sin^2 / (1 + cos) does not.
            one_minus_cos = select(outside, sine2 / (1.0 + sqrt(1.0 - sine2)), 2.0);
        }
    };
};

}  // namespace limn::lights::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
