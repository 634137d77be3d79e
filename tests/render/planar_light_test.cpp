// Points on flat emitters: that near ones are drawn uniformly per solid angle, distant ones per area.
#include "support/chi_square.h"
#include "support/pictures.h"
#include "support/single_shading.h"
#include "support/solid_angle.h"

namespace limn::planar_light_test {

using namespace test;
using flat::PlanarLight;
using flat::PlanarShape;

namespace {

PlanarLight light_of(PlanarShape shape) {
    PlanarLight light;
    light.shape = shape;
    light.primitive = shape == PlanarShape::triangle ? PrimitiveKind::triangle : PrimitiveKind::quad;
    if (shape == PlanarShape::triangle) light.share = 0.5;
    light.corner = {-0.4, 1, -0.3};
    light.edge_u = {1.2, 0.1, 0.2};
    light.edge_v = shape == PlanarShape::rectangle ? Vec3{-0.15, 0, 0.9} : Vec3{0.3, 0.4, 0.8};
    return light;
}

// The p-value that the cells of a grid over the light are met in proportion to the solid angle that they fill.
double solid_angle_p(const PlanarLight& light, const Point3& from) {
    constexpr std::size_t kSide = 12;
    std::vector<double> observed(kSide * kSide * 2), expected(kSide * kSide * 2);
    const auto at = [&](double u, double v) { return light.corner + (u * light.edge_u + v * light.edge_v); };
    const bool triangle = light.shape == PlanarShape::triangle;
    double total = 0;
    for (std::size_t i = 0; i < kSide; ++i)
        for (std::size_t j = 0; j < kSide; ++j) {
            const double u0 = static_cast<double>(i) / kSide, v0 = static_cast<double>(j) / kSide, d = 1.0 / kSide;
            const std::size_t cell = 2 * (i * kSide + j);
            if (!triangle || i + j < kSide)
                expected[cell] = solid_angle(at(u0, v0), at(u0 + d, v0), at(u0, v0 + d), from);
            if (!triangle || i + j + 1 < kSide)
                expected[cell + 1] = solid_angle(at(u0 + d, v0 + d), at(u0 + d, v0), at(u0, v0 + d), from);
            total += expected[cell] + expected[cell + 1];
        }
    for (double& e : expected) e *= kDraws / total;
    std::mt19937_64 random(71);
    bool density = true;
    for (int i = 0; i < kDraws; ++i) {
        const double a = uniform(random);
        const auto s = sample_point(light, from, a, uniform(random));
        const Uv w = s->point.uv;
        density = density && std::abs(s->pdf * total - 1) <= 1e-9 &&
                  std::abs(pdf_point(light, from, s->point.position) * total - 1) <= 1e-9;
        const auto index = [](double x) { return std::min(static_cast<std::size_t>(x * kSide), kSide - 1); };
        const std::size_t cell = 2 * (index(w.u) * kSide + index(w.v));
        const double rest =
            w.u * kSide - static_cast<double>(index(w.u)) + w.v * kSide - static_cast<double>(index(w.v));
        observed[cell + (rest > 1 ? 1 : 0)] += 1;
    }
    CHECK(density);
    // Of a triangle cells beyond the long side are empty, and rounding may put a point there.
    return chi_square_p(observed, expected);
}

}  // namespace

TEST_CASE("Planar lights: near ones are drawn uniformly per solid angle, with the density of that",
          "[render][lights]") {
    for (const PlanarShape shape : {PlanarShape::triangle, PlanarShape::parallelogram, PlanarShape::rectangle}) {
        INFO("shape " << static_cast<int>(shape));
        CHECK(solid_angle_p(light_of(shape), {0.3, 0.4, 0.5}) > kSamplerLevel);
    }
}

TEST_CASE("Planar lights: distant ones are drawn uniformly per area, with the density of that", "[render][lights]") {
    for (const PlanarShape shape : {PlanarShape::triangle, PlanarShape::parallelogram, PlanarShape::rectangle}) {
        const PlanarLight light = light_of(shape);
        const Vec3 scaled = cross(light.edge_u, light.edge_v);
        const double area = length(scaled) * (shape == PlanarShape::triangle ? 0.5 : 1);
        for (const Point3& from : {Point3{2, 9, -3}, Point3{5, -6, 1}}) {
            const auto s = sample_point(light, from, 0.3, 0.6);
            REQUIRE(s);
            const Vec3 way = s->point.position - from;
            const double cosine = std::abs(dot(scaled, way)) / (length(scaled) * length(way));
            CHECK(s->pdf == Approx(length_squared(way) / (cosine * area)).epsilon(1e-13));
            CHECK(pdf_point(light, from, s->point.position) == Approx(s->pdf).epsilon(1e-13));
        }
    }
}

TEST_CASE("Planar lights: from in their plane nothing is drawn", "[render][lights]") {
    for (const PlanarShape shape : {PlanarShape::triangle, PlanarShape::parallelogram, PlanarShape::rectangle}) {
        PlanarLight light = light_of(shape);
        light.edge_u.y = light.edge_v.y = 0;
        for (const double x : {-1.0, 0.0, 30.0}) {
            CHECK_FALSE(sample_point(light, {x, 1, 0.125}, 0.3, 0.6));
            CHECK(pdf_point(light, {x, 1, 0.125}, {x + 0.5, 1, 0.375}) == 0);
        }
    }
}

}  // namespace limn::planar_light_test
