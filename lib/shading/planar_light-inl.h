// Points on triangles, quads and disks. A near light is sampled uniformly per solid angle, a far or small one uniformly
// per area, and a disk always uniformly per area. The include guard is per target, as Highway requires.
#if defined(LIMN_SHADING_PLANAR_LIGHT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_SHADING_PLANAR_LIGHT_INL_H
#undef LIMN_SHADING_PLANAR_LIGHT_INL_H
#else
#define LIMN_SHADING_PLANAR_LIGHT_INL_H
#endif

#include "math/spherical-inl.h"
#include "shading/light_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::lights::HWY_NAMESPACE {

// Lights that fill a smaller solid angle (in steradians) are sampled per area. The inversion that samples a smaller one
// has lost two thirds of its digits. Such a light is small or is seen almost edge-on, so it gives little light however
// it is sampled.
inline constexpr double kSmallSolidAngle = 1e-5;
// Lights that are farther than three of their radii are sampled per area, which costs less and is as good there: the
// pdf per solid angle is proportional to the cube of the distance, because the height over the plane is the same for
// all points of the light. So it varies by ((1 + 1/3) / (1 - 1/3))^3 = 8 at the very most, usually by far less.
// Measured on figures 12 and 15: 1.5 to 4 radii are the same within 3 %. Never sampling per area takes a sixth more
// time per error on figure 15.
inline constexpr double kFarSquared = 3.0 * 3.0;

template <>
struct InLanes<flat::PlanarLight> {
    const LightsOf<flat::PlanarLight>& lights;
    Vector<Doubles> corner, edge_u, edge_v, normal;  // the normal has the length of the parallelogram's area
    Doubles share;
    Mask<Doubles> triangle, rectangle, parallelogram;

    HWY_INLINE explicit InLanes(const LightsOf<flat::PlanarLight>& of)
        : lights(of),
          corner(of(&flat::PlanarLight::corner)),
          edge_u(of(&flat::PlanarLight::edge_u)),
          edge_v(of(&flat::PlanarLight::edge_v)),
          normal(cross(edge_u, edge_v)),
          share(of(&flat::PlanarLight::share)) {
        const Doubles shape = of(&flat::PlanarLight::shape);
        triangle = shape == static_cast<double>(flat::PlanarShape::triangle);
        rectangle = shape == static_cast<double>(flat::PlanarShape::rectangle);
        parallelogram = shape == static_cast<double>(flat::PlanarShape::parallelogram);
    }

    HWY_INLINE LightPoints sample(const Vector<Doubles>& from, Doubles a, Doubles b) const {
        // Sample a point per solid angle or per area.
        Seen seen = see<true>(from, a, b);
        const Mask<Doubles> in_part = (share < 1.0) & (seen.solid_angle == 0.0);
        if (any(in_part)) sample_areas(in_part, seen.point);
        // Compute its position, pdf and normal. The pdf is 0 if the side that faces the receiver doesn't shine.
        LightPoints s;
        s.u = seen.point.u;
        s.v = seen.point.v;
        s.position = corner + (s.u * edge_u + s.v * edge_v);
        s.position_error = lights(&flat::PlanarLight::position_error);
        const Vector<Doubles> way = s.position - from;
        const Doubles along = dot(normal, way), side = lights(&flat::PlanarLight::side);
        s.pdf = select(side * along <= 0.0, pdf_at(from, way, seen.solid_angle), 0.0);
        s.direction = normalize(way);
        const Vector<Doubles> unit = normalize(normal);
        s.normal = select(along > 0.0, -unit, unit);
        return s;
    }

    HWY_INLINE Doubles pdf(const Vector<Doubles>& from, const Vector<Doubles>& position) const {
        return pdf_at(from, position - from, see<false>(from).solid_angle);
    }

private:
    // How receivers see the lights.
    struct Seen {
        Doubles solid_angle;     // 0 if the light is sampled per area
        Weights<Doubles> point;  // if the light is sampled per area, the random numbers
    };

    // The directions from the receivers to the corners of the triangles that a light consists of. A parallelogram
    // consists of two; the second has the corners v, opposite, u.
    struct Halves {
        Vector<Doubles> u, origin, v, opposite;
        Doubles lower, both;  // solid angles of the first triangle, and of the whole light

        HWY_INLINE Halves(const InLanes& light, const Vector<Doubles>& from)
            : u(normalize(light.corner + light.edge_u - from)),
              origin(normalize(light.corner - from)),
              v(normalize(light.corner + light.edge_v - from)),
              opposite(normalize(light.corner + light.edge_u + light.edge_v - from)) {
            lower = both = SphericalTriangle<Doubles>(u, origin, v).solid_angle();
            if (!any(light.parallelogram)) return;
            const Doubles upper = SphericalTriangle<Doubles>(v, opposite, u).solid_angle();
            both = select(light.parallelogram, lower + upper, lower);
        }

        // Returns a direction that is uniform per solid angle.
        HWY_INLINE Vector<Doubles> sample(Doubles a, Doubles b) const {
            const Doubles lower_share = lower / both;
            const Mask<Doubles> below = a < lower_share;
            const SphericalTriangle<Doubles> half(select(below, u, v), select(below, origin, opposite),
                                                  select(below, v, u));
            return half.sample(select(below, a / lower_share, (a - lower_share) / (1.0 - lower_share)), b);
        }
    };

    HWY_INLINE Mask<Doubles> is_far(const Vector<Doubles>& from) const {
        const Vector<Doubles> diagonal = edge_u + edge_v, other = edge_u - edge_v;
        const Doubles half2 = max(length_squared(diagonal), length_squared(other)) / 4.0;
        // The largest distance from a triangle's centroid is two thirds of a median, less than two thirds of the
        // longest side.
        const Doubles side2 = max(max(length_squared(edge_u), length_squared(edge_v)), length_squared(other));
        const Doubles radius2 = select(triangle, (4.0 / 9.0) * side2, half2);
        const Vector<Doubles> center = corner + select(triangle, diagonal / 3.0, 0.5 * diagonal);
        return kFarSquared * radius2 <= length_squared(center - from);
    }

    // Computes the solid angles of the lights that are sampled by them. If `draws`, also samples a point of these.
    template <bool draws>
    HWY_INLINE Seen see(const Vector<Doubles>& from, Doubles a = 0.0, Doubles b = 0.0) const {
        Seen seen{0.0, {a, b}};
        const auto add = [&](Mask<Doubles> lanes, Doubles angle, const auto& sample) HWY_ATTR {
            const Mask<Doubles> by_angle = lanes & (angle >= kSmallSolidAngle);
            seen.solid_angle = select(by_angle, angle, seen.solid_angle);
            if (!draws) return;
            const Weights<Doubles> drawn = sample();
            seen.point = {select(by_angle, drawn.u, seen.point.u), select(by_angle, drawn.v, seen.point.v)};
        };
        const Mask<Doubles> near = !is_far(from);
        const Mask<Doubles> rectangles = near & rectangle, halved = near & (triangle | parallelogram);
        if (any(rectangles)) {
            const SphericalRectangle<Doubles> seen_as(corner, edge_u, edge_v, from);
            add(rectangles, seen_as.solid_angle(), [&]() HWY_ATTR { return seen_as.sample(a, b); });
        }
        if (any(halved)) {
            const Halves halves(*this, from);
            add(halved, halves.both, [&]() HWY_ATTR { return weights_of(from, halves.sample(a, b)); });
        }
        return seen;
    }

    // Returns the weights of the edges where a direction hits the plane. They are clamped to the light, which rounding
    // might leave.
    HWY_INLINE Weights<Doubles> weights_of(const Vector<Doubles>& from, const Vector<Doubles>& direction) const {
        const Vector<Doubles> p = cross(direction, edge_v), s = from - corner;
        const Doubles over = 1.0 / dot(edge_u, p);
        const Mask<Doubles> finite = abs(over) < kInfinity;
        const auto inside = [&](Doubles w) HWY_ATTR { return select(finite, min(max(w, 0.0), 1.0), 0.0); };
        const Doubles u = inside(dot(s, p) * over), v = inside(dot(direction, cross(s, edge_u)) * over);
        const Doubles beyond = select(triangle, max(u + v, 1.0), 1.0);
        return {u / beyond, v / beyond};
    }

    // Samples the given lanes per area.
    HWY_INLINE void sample_areas(Mask<Doubles> lanes, Weights<Doubles>& point) const {
        HWY_ALIGN double u[kLanes<Doubles>], v[kLanes<Doubles>];
        store(point.u, u);
        store(point.v, v);
        for (std::uint32_t rest = bits(lanes); rest != 0; rest &= rest - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(rest));
            const Uv weights = lights[i].sample_area(u[i], v[i]);
            u[i] = weights.u;
            v[i] = weights.v;
        }
        point = {load<Doubles>(u), load<Doubles>(v)};
    }

    // Returns the pdf per solid angle of a point. It is 0 if the light is seen edge-on.
    //
    // \param way from the receiver to the point
    HWY_INLINE Doubles pdf_at(const Vector<Doubles>& from, const Vector<Doubles>& way, Doubles solid_angle) const {
        const Doubles projected = abs(dot(normal, way)) * share, distance2 = length_squared(way);
        const Doubles by_area = select(projected > 0.0, distance2 * sqrt(distance2) / projected, 0.0);
        const Doubles by_angle_or_area = select(solid_angle > 0.0, 1.0 / solid_angle, by_area);
        return select(dot(normal, corner - from) == 0.0, 0.0, by_angle_or_area);
    }
};

}  // namespace limn::lights::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
