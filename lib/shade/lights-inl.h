// Points on lights, drawn as the receivers see them: sample_planar and what goes with it (render/planar_light.h,
// light_sampling.h) in vectors. Per-target include guard, as Highway has it.
#if defined(LIMN_SHADE_LIGHTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_SHADE_LIGHTS_INL_H
#undef LIMN_SHADE_LIGHTS_INL_H
#else
#define LIMN_SHADE_LIGHTS_INL_H
#endif

#include "flat/lights.h"
#include "shade/doubles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::shade::HWY_NAMESPACE {

// A light for each lane.
struct LightLanes {
    Vector<Doubles> origin, edge_u, edge_v, position_error;
    Doubles radius;
    Mask<Doubles> sphere, triangle, rectangle, patch;

    // \param lights as many as there are lanes
    HWY_INLINE explicit LightLanes(const flat::Light* const* lights) {
        const std::size_t n = kLanes<Doubles>;
        bool alike = true;
        for (std::size_t i = 1; i < n; ++i) alike = alike && lights[i] == lights[0];
        if (alike) {
            const flat::Light& l = *lights[0];
            origin = broadcast<Doubles>(l.origin), edge_u = broadcast<Doubles>(l.edge_u);
            edge_v = broadcast<Doubles>(l.edge_v);
            position_error = broadcast<Doubles>(l.position_error), radius = l.radius;
            set_kinds(static_cast<double>(l.kind));
            return;
        }
        HWY_ALIGN double fields[14][8];
        for (std::size_t i = 0; i < n; ++i) {
            const flat::Light& l = *lights[i];
            const double values[] = {l.origin.x,         l.origin.y,
                                     l.origin.z,         l.edge_u.x,
                                     l.edge_u.y,         l.edge_u.z,
                                     l.edge_v.x,         l.edge_v.y,
                                     l.edge_v.z,         l.position_error.x,
                                     l.position_error.y, l.position_error.z,
                                     l.radius,           static_cast<double>(l.kind)};
            for (std::size_t k = 0; k < 14; ++k) fields[k][i] = values[k];
        }
        const auto three = [&](std::size_t k) HWY_ATTR {
            return Vector<Doubles>{load<Doubles>(fields[k]), load<Doubles>(fields[k + 1]),
                                   load<Doubles>(fields[k + 2])};
        };
        origin = three(0), edge_u = three(3), edge_v = three(6), position_error = three(9);
        radius = load<Doubles>(fields[12]);
        set_kinds(load<Doubles>(fields[13]));
    }

private:
    HWY_INLINE void set_kinds(Doubles kind) {
        const auto is = [kind](flat::LightKind k) HWY_ATTR { return kind == static_cast<double>(k); };
        sphere = is(flat::LightKind::sphere), triangle = is(flat::LightKind::triangle);
        rectangle = is(flat::LightKind::rectangle), patch = is(flat::LightKind::patch);
    }
};

// A point on each light, `normal` on the receiver's side. Not drawn: seen edge-on. Open: not for vectors.
struct LightPoints {
    Vector<Doubles> position, normal, direction;
    Doubles pdf;
    Mask<Doubles> drawn, open;
};

// SphericalRectangle (sampling/spherical_rectangle.h). Its four angles are added as complex numbers of length 1, so
// that there is one arc tangent.
struct SphericalRectangles {
    Doubles solid_angle, weight_u, weight_v;

    HWY_INLINE SphericalRectangles(const LightLanes& light, const Vector<Doubles>& from, Doubles u, Doubles v) {
        const Doubles one = 1.0, zero = 0.0;
        const Doubles length_u = sqrt(length_squared(light.edge_u)), length_v = sqrt(length_squared(light.edge_v));
        const Vector<Doubles> x = light.edge_u / length_u, y = light.edge_v / length_v, z = cross(x, y);
        const Vector<Doubles> d = light.origin - from;
        const Doubles x0 = dot(d, x), y0 = dot(d, y), z0 = -abs(dot(d, z));
        const Doubles x1 = x0 + length_u, y1 = y0 + length_v, z2 = z0 * z0;
        // Corners and edges over their distance from `from`.
        const Doubles over_x0 = one / sqrt(x0 * x0 + z2), over_x1 = one / sqrt(x1 * x1 + z2);
        const Doubles over_y0 = one / sqrt(y0 * y0 + z2), over_y1 = one / sqrt(y1 * y1 + z2);
        const auto inner = [&](Doubles cx, Doubles cy, Doubles over_x, Doubles over_y, Doubles sign) HWY_ATTR {
            const Doubles over = over_x * over_y;
            return SineCosine{-z0 * sqrt(cx * cx + cy * cy + z2) * over, sign * (cx * cy) * over};
        };
        const auto sum = [](const SineCosine& a, const SineCosine& b) HWY_ATTR {
            return SineCosine{a.sine * b.cosine + a.cosine * b.sine, a.cosine * b.cosine - a.sine * b.sine};
        };
        const SineCosine g01 = sum(inner(x1, y0, over_x1, over_y0, one), inner(x1, y1, over_x1, over_y1, -1.0));
        const SineCosine g23 = sum(inner(x0, y1, over_x0, over_y1, one), inner(x0, y0, over_x0, over_y0, -1.0));
        solid_angle = select(z0 == zero, zero, angle_of(sum(g01, g23)));
        // au = u * solid_angle + 2 pi - g2 - g3.
        const SineCosine au = sum(sine_cosine_of_turns(u * (solid_angle * (1 / (2 * kPi)))), {-g23.sine, g23.cosine});
        const Doubles b0 = -y0 * over_y0, b1 = y1 * over_y1;
        const Doubles q0 = z2 * (over_y0 * over_y0), q1 = z2 * (over_y1 * over_y1);
        const Mask<Doubles> same_sign = copy_sign(one, b0) == copy_sign(one, b1);
        // cos(au) - 1 where b0 and b1 have the same sign, else cos(au) + 1.
        const Doubles sign = select(same_sign, -1.0, one);
        const Mask<Doubles> cancels = au.cosine * sign < zero;
        const Doubles cosine_less_sign =
            select(cancels, sign * (au.sine * au.sine) / (one - sign * au.cosine), au.cosine + sign);
        const Doubles b_difference = copy_sign(one, b1) * (q1 - q0) / (abs(b0) + abs(b1));
        const Doubles fu = (cosine_less_sign * b0 + b_difference) / au.sine;
        const Doubles root = sqrt(max(fu * fu - q0, 1e-300));
        const Doubles xu = min(max(copy_sign(-z0, fu) / root, x0), x1);
        const Doubles distance2 = xu * xu + z2;
        const Doubles h0 = y0 / sqrt(distance2 + y0 * y0), h1 = y1 / sqrt(distance2 + y1 * y1);
        const Doubles hv = h0 + v * (h1 - h0), rest = one - hv * hv;
        const Doubles inward = min(max(hv * sqrt(distance2 / rest), y0), y1);
        const Doubles yv = select(rest > zero, inward, select(hv < zero, y0, y1));
        weight_u = (xu - x0) / (x1 - x0), weight_v = (yv - y0) / (y1 - y0);
    }
};

HWY_INLINE Mask<Doubles> is_far(const LightLanes& light, const Vector<Doubles>& from) {
    const Vector<Doubles> diagonal = light.edge_u + light.edge_v, other = light.edge_u - light.edge_v;
    const Doubles half2 = max(length_squared(diagonal), length_squared(other)) / 4.0;
    const Doubles side2 = max(max(length_squared(light.edge_u), length_squared(light.edge_v)), length_squared(other));
    const Doubles radius2 = select(light.triangle, (4.0 / 9.0) * side2, half2);
    const Vector<Doubles> center = light.origin + select(light.triangle, diagonal / 3.0, 0.5 * diagonal);
    return flat::kFarSquared * radius2 <= length_squared(center - from);
}

// Triangles and parallelograms only from afar.
HWY_INLINE LightPoints sample_planar(const LightLanes& light, const Vector<Doubles>& from, Doubles u, Doubles v,
                                     Mask<Doubles> wanted) {
    const Doubles zero = 0.0;
    const Vector<Doubles> normal = cross(light.edge_u, light.edge_v);
    const Mask<Doubles> near = (!is_far(light, from)) & wanted;
    // sample_uniform_triangle.
    const Mask<Doubles> upper = v > u;
    const Doubles half = 0.5 * select(upper, u, v);
    Doubles weight_u = select(light.triangle, select(upper, half, u - half), u);
    Doubles weight_v = select(light.triangle, select(upper, v - half, half), v);
    Doubles solid_angle = zero;
    if (any(near)) {
        const SphericalRectangles r(light, from, u, v);
        const Mask<Doubles> seen = near & (r.solid_angle >= flat::kSmallSolidAngle);
        solid_angle = select(seen, r.solid_angle, zero);
        weight_u = select(seen, r.weight_u, weight_u), weight_v = select(seen, r.weight_v, weight_v);
    }
    LightPoints s;
    s.position = light.origin + (weight_u * light.edge_u + weight_v * light.edge_v);
    const Vector<Doubles> way = s.position - from;
    const Doubles distance2 = length_squared(way), towards = dot(normal, way);
    const Doubles projected = abs(towards) * select(light.triangle, 0.5, 1.0);
    const Doubles by_area = select(projected > zero, distance2 * sqrt(distance2) / projected, zero);
    s.pdf = select(solid_angle > zero, 1.0 / solid_angle, by_area);
    s.drawn = (s.pdf > zero) & (dot(normal, light.origin - from) != zero);
    s.open =
        light.patch | ((!light.rectangle) & near) | !(is_ordinary(distance2) & is_ordinary(length_squared(normal)));
    s.direction = normalize(way);
    const Vector<Doubles> unit = normalize(normal);
    s.normal = select(towards > zero, -unit, unit);
    return s;
}

// Still ones.
HWY_INLINE LightPoints sample_sphere(const LightLanes& light, const Vector<Doubles>& from, Doubles u, Doubles v) {
    const Doubles zero = 0.0, one = 1.0;
    const Vector<Doubles> to_center = light.origin - from;
    const Doubles distance2 = length_squared(to_center), radius2 = light.radius * light.radius;
    const Doubles sine2 = radius2 / distance2;
    const Mask<Doubles> outside = sine2 < one;
    const Doubles one_minus_cos = select(outside, sine2 / (one + sqrt(one - sine2)), 2.0);
    LightPoints s;
    s.pdf = one / ((2 * kPi) * one_minus_cos);
    const Vector<Doubles> local = uniform_cone(u, v, one_minus_cos);
    s.direction = select(outside, to_world(normalize(to_center), local), local);
    const Doubles along = dot(to_center, s.direction);
    const Vector<Doubles> foot = along * s.direction - to_center;
    const Doubles half_chord = sqrt(max(zero, radius2 - length_squared(foot)));
    const Vector<Doubles> outward = foot + select(outside, -half_chord, half_chord) * s.direction;
    const Vector<Doubles> normal = normalize(outward);
    s.position = light.origin + light.radius * normal;
    s.normal = select(outside, normal, -normal);
    s.drawn = zero == zero;
    const Mask<Doubles> moves = length_squared(light.edge_u) > zero;
    s.open = moves | !(((!outside) | is_ordinary(distance2)) & is_ordinary(length_squared(outward)));
    return s;
}

}  // namespace limn::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
