// Points on lights, drawn as the receivers see them: sample_planar and what goes with it (render/planar_light.h,
// light_sampling.h) in vectors. Per-target include guard, as Highway has it.
#if defined(LIMN_KERNELS_LIGHTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_KERNELS_LIGHTS_INL_H
#undef LIMN_KERNELS_LIGHTS_INL_H
#else
#define LIMN_KERNELS_LIGHTS_INL_H
#endif

#include "flat/lights.h"
#include "kernels/warps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::kernels::HWY_NAMESPACE {

// A light for each lane.
struct LightLanes {
    W3 origin, edge_u, edge_v, position_error;
    W radius;
    Where sphere, triangle, rectangle, patch;

    // \param lights as many as there are lanes
    HWY_INLINE explicit LightLanes(const flat::Light* const* lights) {
        const std::size_t n = hn::Lanes(Doubles());
        bool alike = true;
        for (std::size_t i = 1; i < n; ++i) alike = alike && lights[i] == lights[0];
        if (alike) {
            const flat::Light& l = *lights[0];
            origin = all(l.origin - Point3{}), edge_u = all(l.edge_u), edge_v = all(l.edge_v);
            position_error = all(l.position_error), radius = all(l.radius);
            set_kinds(all(static_cast<double>(l.kind)));
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
            return W3{LoadLane(fields[k]), LoadLane(fields[k + 1]), LoadLane(fields[k + 2])};
        };
        origin = three(0), edge_u = three(3), edge_v = three(6), position_error = three(9);
        radius = LoadLane(fields[12]);
        set_kinds(LoadLane(fields[13]));
    }

private:
    HWY_INLINE void set_kinds(W kind) {
        const auto is = [kind](flat::LightKind k) HWY_ATTR { return hn::Eq(kind, all(static_cast<double>(k))); };
        sphere = is(flat::LightKind::sphere), triangle = is(flat::LightKind::triangle);
        rectangle = is(flat::LightKind::rectangle), patch = is(flat::LightKind::patch);
    }
};

// A point on each light, `normal` on the receiver's side. Not drawn: seen edge-on. Open: not for vectors.
struct LightPoints {
    W3 position, normal, direction;
    W pdf;
    Where drawn, open;
};

// SphericalRectangle (render/spherical_rectangle.h). Its four angles are added as complex numbers of length 1, so that
// there is one arc tangent.
struct SphericalRectangles {
    W solid_angle, weight_u, weight_v;

    HWY_INLINE SphericalRectangles(const LightLanes& light, const W3& from, W u, W v) {
        const W one = all(1.0), zero = all(0.0);
        const W length_u = hn::Sqrt(length_squared(light.edge_u)), length_v = hn::Sqrt(length_squared(light.edge_v));
        const W3 x = light.edge_u / length_u, y = light.edge_v / length_v, z = cross(x, y);
        const W3 d = light.origin - from;
        const W x0 = dot(d, x), y0 = dot(d, y), z0 = hn::Neg(hn::Abs(dot(d, z)));
        const W x1 = x0 + length_u, y1 = y0 + length_v, z2 = z0 * z0;
        // Corners and edges over their distance from `from`.
        const W over_x0 = one / hn::Sqrt(x0 * x0 + z2), over_x1 = one / hn::Sqrt(x1 * x1 + z2);
        const W over_y0 = one / hn::Sqrt(y0 * y0 + z2), over_y1 = one / hn::Sqrt(y1 * y1 + z2);
        const auto inner = [&](W cx, W cy, W over_x, W over_y, W sign) HWY_ATTR {
            const W over = over_x * over_y;
            return SineCosine{hn::Neg(z0) * hn::Sqrt(cx * cx + cy * cy + z2) * over, sign * (cx * cy) * over};
        };
        const auto sum = [](const SineCosine& a, const SineCosine& b) HWY_ATTR {
            return SineCosine{a.sine * b.cosine + a.cosine * b.sine, a.cosine * b.cosine - a.sine * b.sine};
        };
        const SineCosine g01 = sum(inner(x1, y0, over_x1, over_y0, one), inner(x1, y1, over_x1, over_y1, all(-1.0)));
        const SineCosine g23 = sum(inner(x0, y1, over_x0, over_y1, one), inner(x0, y0, over_x0, over_y0, all(-1.0)));
        solid_angle = choose(hn::Eq(z0, zero), zero, angle_of(sum(g01, g23)));
        // au = u * solid_angle + 2 pi - g2 - g3.
        const SineCosine au =
            sum(sine_cosine_of_turns(u * (solid_angle * all(1 / (2 * kPi)))), {hn::Neg(g23.sine), g23.cosine});
        const W b0 = hn::Neg(y0) * over_y0, b1 = y1 * over_y1;
        const W q0 = z2 * squared(over_y0), q1 = z2 * squared(over_y1);
        const Where same_sign = hn::Eq(hn::CopySign(one, b0), hn::CopySign(one, b1));
        // cos(au) - 1 where b0 and b1 have the same sign, else cos(au) + 1.
        const W sign = choose(same_sign, all(-1.0), one);
        const Where cancels = hn::Lt(au.cosine * sign, zero);
        const W cosine_less_sign =
            choose(cancels, sign * squared(au.sine) / (one - sign * au.cosine), au.cosine + sign);
        const W b_difference = hn::CopySign(one, b1) * (q1 - q0) / (hn::Abs(b0) + hn::Abs(b1));
        const W fu = (cosine_less_sign * b0 + b_difference) / au.sine;
        const W root = hn::Sqrt(hn::Max(fu * fu - q0, all(1e-300)));
        const W xu = hn::Min(hn::Max(hn::CopySign(hn::Neg(z0), fu) / root, x0), x1);
        const W distance2 = xu * xu + z2;
        const W h0 = y0 / hn::Sqrt(distance2 + y0 * y0), h1 = y1 / hn::Sqrt(distance2 + y1 * y1);
        const W hv = h0 + v * (h1 - h0), rest = one - hv * hv;
        const W inward = hn::Min(hn::Max(hv * hn::Sqrt(distance2 / rest), y0), y1);
        const W yv = choose(hn::Gt(rest, zero), inward, choose(hn::Lt(hv, zero), y0, y1));
        weight_u = (xu - x0) / (x1 - x0), weight_v = (yv - y0) / (y1 - y0);
    }
};

HWY_INLINE Where is_far(const LightLanes& light, const W3& from) {
    const W3 diagonal = light.edge_u + light.edge_v, other = light.edge_u - light.edge_v;
    const W half2 = hn::Max(length_squared(diagonal), length_squared(other)) / all(4.0);
    const W side2 = hn::Max(hn::Max(length_squared(light.edge_u), length_squared(light.edge_v)), length_squared(other));
    const W radius2 = choose(light.triangle, all(4.0 / 9.0) * side2, half2);
    const W3 center = light.origin + choose(light.triangle, diagonal / all(3.0), all(0.5) * diagonal);
    return hn::Le(all(flat::kFarSquared) * radius2, length_squared(center - from));
}

// Triangles and parallelograms only from afar.
HWY_INLINE LightPoints sample_planar(const LightLanes& light, const W3& from, W u, W v, Where wanted) {
    const W zero = all(0.0);
    const W3 normal = cross(light.edge_u, light.edge_v);
    const Where near = hn::AndNot(is_far(light, from), wanted);
    // sample_uniform_triangle.
    const Where upper = hn::Gt(v, u);
    const W half = all(0.5) * choose(upper, u, v);
    W weight_u = choose(light.triangle, choose(upper, half, u - half), u);
    W weight_v = choose(light.triangle, choose(upper, v - half, half), v);
    W solid_angle = zero;
    if (any(near)) {
        const SphericalRectangles r(light, from, u, v);
        const Where seen = hn::And(near, hn::Ge(r.solid_angle, all(flat::kSmallSolidAngle)));
        solid_angle = choose(seen, r.solid_angle, zero);
        weight_u = choose(seen, r.weight_u, weight_u), weight_v = choose(seen, r.weight_v, weight_v);
    }
    LightPoints s;
    s.position = light.origin + (weight_u * light.edge_u + weight_v * light.edge_v);
    const W3 way = s.position - from;
    const W distance2 = length_squared(way), towards = dot(normal, way);
    const W projected = hn::Abs(towards) * choose(light.triangle, all(0.5), all(1.0));
    const W by_area = choose(hn::Gt(projected, zero), distance2 * hn::Sqrt(distance2) / projected, zero);
    s.pdf = choose(hn::Gt(solid_angle, zero), all(1.0) / solid_angle, by_area);
    s.drawn = hn::And(hn::Gt(s.pdf, zero), hn::Ne(dot(normal, light.origin - from), zero));
    s.open = hn::Or(hn::Or(light.patch, hn::AndNot(light.rectangle, near)),
                    hn::Not(hn::And(is_ordinary(distance2), is_ordinary(length_squared(normal)))));
    s.direction = normalize(way);
    const W3 unit = normalize(normal);
    s.normal = choose(hn::Gt(towards, zero), -unit, unit);
    return s;
}

// Still ones.
HWY_INLINE LightPoints sample_sphere(const LightLanes& light, const W3& from, W u, W v) {
    const W zero = all(0.0), one = all(1.0);
    const W3 to_center = light.origin - from;
    const W distance2 = length_squared(to_center), radius2 = light.radius * light.radius;
    const W sine2 = radius2 / distance2;
    const Where outside = hn::Lt(sine2, one);
    const W one_minus_cos = choose(outside, sine2 / (one + hn::Sqrt(one - sine2)), all(2.0));
    LightPoints s;
    s.pdf = one / (all(2 * kPi) * one_minus_cos);
    const W3 local = uniform_cone(u, v, one_minus_cos);
    s.direction = choose(outside, to_world(normalize(to_center), local), local);
    const W along = dot(to_center, s.direction);
    const W3 foot = along * s.direction - to_center;
    const W half_chord = hn::Sqrt(hn::Max(zero, radius2 - length_squared(foot)));
    const W3 outward = foot + choose(outside, hn::Neg(half_chord), half_chord) * s.direction;
    const W3 normal = normalize(outward);
    s.position = light.origin + light.radius * normal;
    s.normal = choose(outside, normal, -normal);
    s.drawn = hn::Eq(zero, zero);
    const Where moves = hn::Gt(length_squared(light.edge_u), zero);
    s.open = hn::Or(moves, hn::Not(hn::And(hn::Or(hn::Not(outside), is_ordinary(distance2)),
                                           is_ordinary(length_squared(outward)))));
    return s;
}

}  // namespace limn::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
