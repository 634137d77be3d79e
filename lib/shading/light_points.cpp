#include "shading/light_points.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/light_points.cpp"
#include <hwy/foreach_target.h>

#include <bit>

#include "math/rows-inl.h"
#include "math/spherical-inl.h"
#include "math/warps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::lights::HWY_NAMESPACE {

using namespace sampling::HWY_NAMESPACE;

// A light for each lane, spheres still.
struct LightLanes {
    Vector<Doubles> origin, edge_u, edge_v, position_error;
    Doubles radius, share, side;
    Mask<Doubles> sphere, triangle, rectangle, parallelogram, point;

    // \param lights as many as there are lanes
    HWY_INLINE explicit LightLanes(const flat::Light* const* lights) {
        const std::size_t n = kLanes<Doubles>;
        bool alike = true;
        for (std::size_t i = 1; i < n; ++i) alike = alike && lights[i] == lights[0];
        if (alike) {
            const flat::Light& l = *lights[0];
            origin = broadcast<Doubles>(l.origin), edge_u = broadcast<Doubles>(l.edge_u);
            edge_v = broadcast<Doubles>(l.edge_v), position_error = broadcast<Doubles>(l.position_error);
            radius = l.radius, share = l.share, side = static_cast<double>(l.side);
            set_kind(static_cast<double>(l.kind));
            return;
        }
        HWY_ALIGN double fields[16][8];
        for (std::size_t i = 0; i < n; ++i) {
            const flat::Light& l = *lights[i];
            const double values[] = {l.origin.x,
                                     l.origin.y,
                                     l.origin.z,
                                     l.edge_u.x,
                                     l.edge_u.y,
                                     l.edge_u.z,
                                     l.edge_v.x,
                                     l.edge_v.y,
                                     l.edge_v.z,
                                     l.position_error.x,
                                     l.position_error.y,
                                     l.position_error.z,
                                     l.radius,
                                     l.share,
                                     static_cast<double>(l.kind),
                                     static_cast<double>(l.side)};
            for (std::size_t k = 0; k < 16; ++k) fields[k][i] = values[k];
        }
        const auto three = [&](std::size_t k) HWY_ATTR {
            return Vector<Doubles>{load<Doubles>(fields[k]), load<Doubles>(fields[k + 1]),
                                   load<Doubles>(fields[k + 2])};
        };
        origin = three(0), edge_u = three(3), edge_v = three(6), position_error = three(9);
        radius = load<Doubles>(fields[12]), share = load<Doubles>(fields[13]);
        set_kind(load<Doubles>(fields[14])), side = load<Doubles>(fields[15]);
    }

private:
    HWY_INLINE void set_kind(Doubles kind) {
        const auto is = [kind](flat::LightKind k) HWY_ATTR { return kind == static_cast<double>(k); };
        sphere = is(flat::LightKind::sphere), triangle = is(flat::LightKind::triangle);
        rectangle = is(flat::LightKind::rectangle), parallelogram = is(flat::LightKind::parallelogram);
        point = kind >= static_cast<double>(flat::LightKind::point);
    }
};

// As in LightSamples.
struct Points {
    Vector<Doubles> position, normal, direction;
    Doubles pdf, u, v;
};

// The sphere as the receiver sees it. From inside it is everywhere.
struct Cone {
    Vector<Doubles> to_center;
    Doubles one_minus_cos;
    Mask<Doubles> outside;

    HWY_INLINE Cone(const LightLanes& light, const Vector<Doubles>& from) : to_center(light.origin - from) {
        const Doubles sine2 = light.radius * light.radius / length_squared(to_center);
        outside = sine2 < 1.0;
        // sin^2 / (1 + cos) rather than 1 - cos, which vanishes for distant spheres.
        one_minus_cos = select(outside, sine2 / (1.0 + sqrt(1.0 - sine2)), 2.0);
    }
};

HWY_INLINE Points sample_sphere(const LightLanes& light, const Vector<Doubles>& from, Doubles u, Doubles v) {
    const Cone cone(light, from);
    const Vector<Doubles> local = uniform_cone(u, v, cone.one_minus_cos);
    Points s;
    s.direction = select(cone.outside, Basis<Doubles>(normalize(cone.to_center)).to_world(local), local);
    // Where the direction meets the sphere: along it to the foot of the centre, then half a chord back (from inside:
    // forward). At the rim rounding may leave no chord.
    const Vector<Doubles> foot = dot(cone.to_center, s.direction) * s.direction - cone.to_center;
    const Doubles half_chord = sqrt(max(0.0, light.radius * light.radius - length_squared(foot)));
    const Vector<Doubles> normal = normalize(foot + select(cone.outside, -half_chord, half_chord) * s.direction);
    s.position = light.origin + light.radius * normal;
    s.normal = select(cone.outside, normal, -normal);
    const Mask<Doubles> shines = select(cone.outside, light.side, -light.side) >= 0.0;
    s.pdf = select(shines & (length_squared(normal) < 2.0), uniform_cone_pdf(cone.one_minus_cos), 0.0);  // else NaN
    return s;
}

HWY_INLINE Mask<Doubles> is_far(const LightLanes& light, const Vector<Doubles>& from) {
    const Vector<Doubles> diagonal = light.edge_u + light.edge_v, other = light.edge_u - light.edge_v;
    const Doubles half2 = max(length_squared(diagonal), length_squared(other)) / 4.0;
    // The longest way from a triangle's centroid is two thirds of a median, less than two thirds of the longest side.
    const Doubles side2 = max(max(length_squared(light.edge_u), length_squared(light.edge_v)), length_squared(other));
    const Doubles radius2 = select(light.triangle, (4.0 / 9.0) * side2, half2);
    const Vector<Doubles> center = light.origin + select(light.triangle, diagonal / 3.0, 0.5 * diagonal);
    return flat::kFarSquared * radius2 <= length_squared(center - from);
}

// The triangles that a light is made of: itself, or the two of a parallelogram, which have the vertices origin, u, v,
// and what is opposite.
struct Halves {
    Vector<Doubles> u, origin, v, opposite;
    Doubles lower, both;  // solid angles

    HWY_INLINE Halves(const LightLanes& light, const Vector<Doubles>& from)
        : u(normalize(light.origin + light.edge_u - from)),
          origin(normalize(light.origin - from)),
          v(normalize(light.origin + light.edge_v - from)),
          opposite(normalize(light.origin + light.edge_u + light.edge_v - from)) {
        lower = both = SphericalTriangle<Doubles>(u, origin, v).solid_angle();
        if (!any(light.parallelogram)) return;
        const Doubles upper = SphericalTriangle<Doubles>(v, opposite, u).solid_angle();
        both = select(light.parallelogram, lower + upper, lower);
    }

    HWY_INLINE Vector<Doubles> sample(Doubles a, Doubles b) const {
        const Doubles share = lower / both;
        const Mask<Doubles> below = a < share;
        const SphericalTriangle<Doubles> half(select(below, u, v), select(below, origin, opposite),
                                              select(below, v, u));
        return half.sample(select(below, a / share, (a - share) / (1.0 - share)), b);
    }
};

// Where a direction meets the plane, as weights of the edges; rounding may not leave the light.
HWY_INLINE Weights<Doubles> weights_of(const LightLanes& light, const Vector<Doubles>& from,
                                       const Vector<Doubles>& direction) {
    const Vector<Doubles> p = cross(direction, light.edge_v), s = from - light.origin;
    const Doubles over = 1.0 / dot(light.edge_u, p);
    const Mask<Doubles> finite = abs(over) < kInfinity;
    const auto inside = [&](Doubles w) HWY_ATTR { return select(finite, min(max(w, 0.0), 1.0), 0.0); };
    const Doubles u = inside(dot(s, p) * over), v = inside(dot(direction, cross(s, light.edge_u)) * over);
    const Doubles beyond = select(light.triangle, max(u + v, 1.0), 1.0);
    return {u / beyond, v / beyond};
}

// The solid angles of lights that are near, and points uniform in them; 0 of others, and of small ones.
struct Seen {
    Doubles solid_angle;
    Weights<Doubles> point;

    template <bool draws>
    static HWY_INLINE Seen of(const LightLanes& light, const Vector<Doubles>& from, Doubles a = 0.0, Doubles b = 0.0) {
        Seen s{0.0, {a, b}};
        const auto add = [&](Mask<Doubles> lanes, Doubles angle, const auto& sample) HWY_ATTR {
            const Mask<Doubles> seen = lanes & (angle >= flat::kSmallSolidAngle);
            s.solid_angle = select(seen, angle, s.solid_angle);
            if (!draws) return;
            const Weights<Doubles> drawn = sample();
            s.point = {select(seen, drawn.u, s.point.u), select(seen, drawn.v, s.point.v)};
        };
        const Mask<Doubles> near = !is_far(light, from);
        const Mask<Doubles> rectangles = near & light.rectangle, halved = near & (light.triangle | light.parallelogram);
        if (any(rectangles)) {
            const SphericalRectangle<Doubles> rectangle(light.origin, light.edge_u, light.edge_v, from);
            add(rectangles, rectangle.solid_angle(), [&]() HWY_ATTR { return rectangle.sample(a, b); });
        }
        if (any(halved)) {
            const Halves halves(light, from);
            add(halved, halves.both, [&]() HWY_ATTR { return weights_of(light, from, halves.sample(a, b)); });
        }
        return s;
    }
};

// Density per solid angle of points on planar lights; 0 where they are seen edge-on.
HWY_INLINE Doubles planar_pdf(const LightLanes& light, const Vector<Doubles>& normal, const Vector<Doubles>& from,
                              const Vector<Doubles>& way, Doubles solid_angle) {
    const Doubles projected = abs(dot(normal, way)) * light.share, distance2 = length_squared(way);
    const Doubles by_area = select(projected > 0.0, distance2 * sqrt(distance2) / projected, 0.0);
    const Doubles pdf = select(solid_angle > 0.0, 1.0 / solid_angle, by_area);
    return select(dot(normal, light.origin - from) == 0.0, 0.0, pdf);
}

// By area, of lights that are not the whole of their patch.
HWY_INLINE void sample_areas(const flat::Light* const* lights, Mask<Doubles> wanted, Weights<Doubles>& point) {
    HWY_ALIGN double u[8], v[8];
    store(point.u, u), store(point.v, v);
    for (std::uint32_t rest = bits(wanted); rest != 0; rest &= rest - 1) {
        const int i = std::countr_zero(rest);
        const Uv weights = flat::sample_area(*lights[i], u[i], v[i]);
        u[i] = weights.u, v[i] = weights.v;
    }
    point = {load<Doubles>(u), load<Doubles>(v)};
}

HWY_INLINE Points sample_planar(const LightLanes& light, const flat::Light* const* lights, const Vector<Doubles>& from,
                                Doubles u, Doubles v) {
    Seen seen = Seen::of<true>(light, from, u, v);
    const Mask<Doubles> in_part = (light.share < 1.0) & (seen.solid_angle == 0.0);
    if (any(in_part)) sample_areas(lights, in_part, seen.point);
    Points s;
    s.u = seen.point.u, s.v = seen.point.v;
    s.position = light.origin + (s.u * light.edge_u + s.v * light.edge_v);
    const Vector<Doubles> way = s.position - from, normal = cross(light.edge_u, light.edge_v);
    const Doubles along = dot(normal, way);
    s.pdf = select(light.side * along <= 0.0, planar_pdf(light, normal, from, way, seen.solid_angle), 0.0);
    s.direction = normalize(way);
    const Vector<Doubles> unit = normalize(normal);
    s.normal = select(along > 0.0, -unit, unit);
    return s;
}

// As many as there are lanes, where there are fewer lights too.
struct Chosen {
    const flat::Light* lights[8];

    HWY_INLINE Chosen(const flat::Light* const* all, std::size_t i, std::size_t count) {
        static constexpr flat::Light kNone{};
        for (std::size_t j = 0; j < kLanes<Doubles>; ++j) lights[j] = i + j < count && all[i + j] ? all[i + j] : &kNone;
    }
};

void sample_points(const Receivers& receivers, LightSamples& samples) {
    for (std::size_t i = 0; i < receivers.count; i += kLanes<Doubles>) {
        const Chosen chosen(samples.light, i, receivers.count);
        const LightLanes light(chosen.lights);
        const Vector<Doubles> from = load3<Doubles>(receivers.position, i);
        const Doubles u = load<Doubles>(samples.numbers[1] + i), v = load<Doubles>(samples.numbers[2] + i);
        Points s;
        s.u = s.v = s.pdf = 0.0;
        if (any(!light.sphere)) s = sample_planar(light, chosen.lights, from, u, v);
        if (any(light.sphere)) {
            const Points round = sample_sphere(light, from, u, v);
            s.position = select(light.sphere, round.position, s.position);
            s.normal = select(light.sphere, round.normal, s.normal);
            s.direction = select(light.sphere, round.direction, s.direction);
            s.pdf = select(light.sphere, round.pdf, s.pdf);
        }
        if (any(light.point)) {
            const Vector<Doubles> way = light.origin - from;
            s.position = select(light.point, light.origin, s.position);
            s.normal = select(light.point, {0.0, 0.0, 0.0}, s.normal);
            s.direction = select(light.point, normalize(way), s.direction);
            s.pdf = select(light.point, length_squared(way) * (1 / flat::kNoSolidAngle), s.pdf);
        }
        store3(s.position, samples.position, i), store3(light.position_error, samples.position_error, i);
        store3(s.normal, samples.normal, i), store3(s.direction, samples.direction, i);
        store(s.pdf, samples.pdf + i), store(s.u, samples.u + i), store(s.v, samples.v + i);
    }
}

void find_point_pdf(const Receivers& receivers, const flat::Light* const* lights, const Rows3& position, Row& pdf) {
    for (std::size_t i = 0; i < receivers.count; i += kLanes<Doubles>) {
        const LightLanes light(Chosen(lights, i, receivers.count).lights);
        const Vector<Doubles> from = load3<Doubles>(receivers.position, i);
        const Vector<Doubles> normal = cross(light.edge_u, light.edge_v);
        const Doubles planar = planar_pdf(light, normal, from, load3<Doubles>(position, i) - from,
                                          Seen::of<false>(light, from).solid_angle);
        store(select(light.sphere, uniform_cone_pdf(Cone(light, from).one_minus_cos), planar), pdf + i);
    }
}

}  // namespace limn::lights::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn::lights {

HWY_EXPORT(sample_points);
HWY_EXPORT(find_point_pdf);

void sample_points(const Receivers& receivers, LightSamples& samples) {
    HWY_DYNAMIC_DISPATCH(sample_points)(receivers, samples);
}

void find_point_pdf(const Receivers& receivers, const flat::Light* const* lights, const Rows3& position, Row& pdf) {
    HWY_DYNAMIC_DISPATCH(find_point_pdf)(receivers, lights, position, pdf);
}

}  // namespace limn::lights
#endif
