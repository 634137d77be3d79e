// The batches of lib/shading and lib/math for one receiver. lib/shading/single.h has those for one vertex.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "math/spherical-inl.h"
#include "shading/light_choice.h"
#include "shading/light_points.h"
#include "shading/lights.h"
#include "shading/shading.h"
#include "shading/single.h"
#include "support/light_of.h"

namespace limn::test {

using shade::material_value, shade::OneReceiver, shade::pdf_light, shade::power_heuristic, shade::Receiver,
    shade::sample_material;

struct LightSample {
    Surface point;
    Vec3 direction;
    double pdf = 0;
};

inline std::optional<LightSample> first_of(const lights::LightSamples& rows) {
    if (!(rows.pdf[0] > 0)) return std::nullopt;
    LightSample s;
    s.point.position = rows.position.get<Point3>(0), s.point.position_error = rows.position_error.get<Vec3>(0);
    s.point.normal = s.point.shading_normal = rows.normal.get<Normal3>(0);
    s.point.uv = {rows.u[0], rows.v[0]};
    if (const flat::SurfaceLight* light = surface_of(*rows.light[0]))
        s.point.material.id = static_cast<std::uint32_t>(light->material);
    s.direction = rows.direction.get<Vec3>(0), s.pdf = rows.pdf[0];
    return s;
}

inline std::optional<LightSample> sample_light(const flat::Scene& scene, const Receiver& receiver, double time,
                                               double pick, double u, double v) {
    const sampling::Row numbers[3] = {{pick}, {u}, {v}};
    const auto rows = std::make_unique<lights::LightSamples>();
    rows->numbers = numbers;
    lights::sample(scene, OneReceiver(receiver, time).rows(), *rows);
    std::optional<LightSample> s = first_of(*rows);
    const flat::SurfaceLight* light = surface_of(*rows->light[0]);
    if (s && light && light->textured) s->point.uv = shade::texture_coordinates_of(scene, *rows, 0);
    return s;
}

// On one light.
inline std::optional<LightSample> sample_point(const flat::Light& light, const Point3& from, double u, double v) {
    const sampling::Row numbers[3] = {{}, {u}, {v}};
    const auto rows = std::make_unique<lights::LightSamples>();
    rows->numbers = numbers;
    rows->light[0] = &light;
    lights::sample_points(OneReceiver({from, {}}).rows(), *rows);
    return first_of(*rows);
}

inline double pdf_point(const flat::Light& light, const Point3& from, const Point3& at) {
    const flat::Light* lights[sampling::kShaded] = {&light};
    sampling::Rows3 position;
    position.set(0, at);
    sampling::Row pdf = {};
    lights::find_point_pdf(OneReceiver({from, {}}).rows(), lights, position, pdf);
    return pdf[0];
}

struct LightChoice {
    std::size_t rank;
    double probability;
};

inline std::optional<LightChoice> choose_light(const flat::LightTable& lights, const Receiver& receiver, double pick) {
    std::array<lights::Choice, sampling::kShaded> choices;
    const sampling::Row picks = {pick};
    lights::choose(lights, OneReceiver(receiver).rows(), picks, choices.data());
    if (!(choices[0].probability > 0)) return std::nullopt;
    return LightChoice{choices[0].rank, choices[0].probability};
}

inline double probability_of(const flat::LightTable& lights, const Receiver& receiver, std::size_t rank) {
    const sampling::Row ranks = {static_cast<double>(rank)};
    sampling::Row probability = {};
    lights::find_probability(lights, OneReceiver(receiver).rows(), ranks, probability);
    return probability[0];
}

using Lanes3 = limn::HWY_NAMESPACE::Vector<double>;

class SphericalRectangle {
public:
    SphericalRectangle(const Point3& corner, const Vec3& edge_u, const Vec3& edge_v, const Point3& from)
        : r_(broadcast(corner), broadcast(edge_u), broadcast(edge_v), broadcast(from)) {}
    double solid_angle() const { return r_.solid_angle(); }
    Uv sample(double u, double v) const {
        const auto w = r_.sample(u, v);
        return {w.u, w.v};
    }

    template <class Three>
    static Lanes3 broadcast(const Three& v) {
        return {v.x, v.y, v.z};
    }

private:
    sampling::HWY_NAMESPACE::SphericalRectangle<double> r_;
};

class SphericalTriangle {
public:
    SphericalTriangle(const Vec3& a, const Vec3& b, const Vec3& c)
        : t_(SphericalRectangle::broadcast(a), SphericalRectangle::broadcast(b), SphericalRectangle::broadcast(c)) {}
    double solid_angle() const { return t_.solid_angle(); }
    Vec3 sample(double u, double v) const {
        const Lanes3 d = t_.sample(u, v);
        return {d.x, d.y, d.z};
    }

private:
    sampling::HWY_NAMESPACE::SphericalTriangle<double> t_;
};

}  // namespace limn::test
