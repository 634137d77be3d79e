// Directions towards lights: that they lead where they say, and with which density.
#include "limn/scene/texture/checker.h"
#include "property.h"
#include "support/chi_square.h"
#include "support/pictures.h"
#include "support/single_shading.h"
#include "support/solid_angle.h"

namespace limn::light_sampling_test {

using namespace test;

namespace {

// A radiance that is not the same everywhere, so that texture coordinates are asked for.
MaterialPtr chequered_lamp() {
    return std::make_shared<DiffuseLight>(std::make_shared<Checker>(0.1, Color{1, 1, 1}, Color{2, 2, 2}));
}

MeshData one_triangle() {
    MeshData mesh;
    mesh.vertices = {{-1, 2, 0}, {1.5F, 2, 0.5F}, {0, 2.5F, 2}};
    mesh.triangles = {{0, 1, 2}};
    mesh.uvs = {{0.25F, 0.5F}, {2, -1}, {-0.5F, 3}};
    return mesh;
}

constexpr std::size_t kKinds = 10;

// One light near (0, 2, 0), none larger than 3.
Object light_of_kind(std::size_t kind, const MaterialPtr& m) {
    switch (kind) {
        case 0: return std::make_shared<Triangle>(Point3{-1, 1.5, 0}, Point3{1.5, 2, 0.5}, Point3{0, 2.5, 2}, m);
        case 1: return std::make_shared<Mesh>(one_triangle(), m);
        case 2: return quad({-0.5, 2, -0.25}, {2, 0.25, 0}, {0.5, -0.5, 1.5}, m);  // no right angles
        case 3: return quad({-0.5, 2, -0.25}, {2, 0, 0.5}, {-0.25, 1, 1}, m);      // a rectangle
        case 4: return quad({-0.5, 2, -0.25}, {1e-4, 0, 0}, {0, 1e-4, 1e-4}, m);   // one of tiny solid angle
        case 5: return sphere({1, 2, -0.5}, 0.75, m);
        case 6: return sphere({1, 2, -0.5}, -0.75, m);
        case 7: return std::make_shared<Sphere>(Point3{1, 2, -0.5}, Point3{-1, 2.5, 0.5}, 0.5, m);
        case 8:
            return std::make_shared<Instance>(
                quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, m),
                Transform::translate({0, 2, 0}) * Transform::rotate({1, 2, 0}, 40) * Transform::scale(1.5, -0.5, 2));
        default:
            return std::make_shared<Instance>(
                sphere({0.5, 0, 0}, 1, m),
                Transform::translate({0, 2, 0}) * Transform::rotate({1, 2, 0}, 40) * Transform::scale(0.5, -0.5, 0.5));
    }
}

// Around the lights; for spheres now and then inside.
Point3 receiver(Random& random, std::size_t kind) {
    if ((kind == 5 || kind == 6) && random.chance(0.3))
        return Point3{1, 2, -0.5} + 0.7 * random.uniform() * random.unit();
    return Point3{0, 2, 0} + random.uniform(2.5, 6) * random.unit();
}

std::optional<LightSample> draw(const CompiledScene& scene, const Point3& from, double time, Random& random) {
    const double pick = random.uniform(), u = random.uniform();
    return sample_light(scene.flat(), {from, {}}, time, pick, u, random.uniform());
}

}  // namespace

TEST_CASE("Light sampling: a ray in the direction drawn meets the lamp at the point drawn, and finds the same density",
          "[render][lights]") {
    for (std::size_t kind = 0; kind < kKinds; ++kind) {
        const bool textured = kind != 6 && kind != 9;  // such a ball is sampled only if it is plain
        const CompiledScene scene =
            compile_with(sky(0), {light_of_kind(kind, textured ? chequered_lamp() : lamp(3)), ball({0, -9, 0}, 1)});
        REQUIRE(scene.stats().lights == 1);
        INFO("kind " << kind);
        holds([&](std::uint64_t seed) {
            Random random(seed);
            const Point3 from = receiver(random, kind);
            const double time = random.uniform();
            const std::optional<LightSample> s = draw(scene, from, time, random);
            if (!s) RC_DISCARD("seen edge-on");
            const Vec3 way = s->point.position - from;
            const double distance = length(way);
            RC_ASSERT(std::abs(length(s->direction) - 1) <= gamma(8));
            RC_ASSERT(length(s->direction - way / distance) <= 1e-6);  // at a ball's rim the chord is short
            const Ray ray{.origin = from, .direction = s->direction, .time = time};
            const std::optional<RayHit> hit = scene.closest_hit(ray);
            if (!hit) RC_DISCARD("past the rim by rounding");
            const Surface at = scene.surface_at(ray, *hit);
            const double grazing = std::abs(dot(at.normal, s->direction));
            if (grazing < 1e-3) RC_DISCARD("too flat for numbers to agree");
            const double near = 1e-10 / (grazing * grazing);
            RC_ASSERT(std::abs(hit->t - distance) <= near);
            RC_ASSERT(length(at.position - s->point.position) <= near);
            RC_ASSERT(length(Vec3(at.normal) - Vec3(s->point.normal)) <= near);
            RC_ASSERT(s->point.shading_normal == s->point.normal);
            RC_ASSERT(s->point.material.id == at.material.id);
            if (textured) {
                const double scale = kind == 4 ? 1e4 : 1;  // its uv change as much faster
                const double du = std::abs(s->point.uv.u - at.uv.u), dv = std::abs(s->point.uv.v - at.uv.v);
                RC_ASSERT(std::min(du, std::abs(1 - du)) <= 1e2 * scale * near);
                RC_ASSERT(dv <= 1e2 * scale * near);
            }
            const double pdf = pdf_light(scene.flat(), {from, {}}, time, hit->primitive, at.position);
            RC_ASSERT(std::abs(pdf - s->pdf) <= 1e2 * near * pdf);
            // gamma(64), 7e-15, of coordinates and edges of some units; an instance multiplies by its stretch, twice.
            RC_ASSERT(max_abs(s->point.position_error) > 0 && max_abs(s->point.position_error) <= 4e-12);
        });
    }
}

TEST_CASE("Light sampling: 1 / pdf has the solid angle as its mean, direction / pdf the vector irradiance",
          "[render][lights]") {
    // The vector irradiance is the integral of the direction, so light drawn from a wrong part of the lamp shows.
    struct Truth {
        double solid_angle = 0;
        Vec3 direction;
    };
    const auto polygon = [](const std::vector<Point3>& p, const Point3& from) {
        double angle = 0;
        for (std::size_t i = 2; i < p.size(); ++i) angle += solid_angle(p[0], p[i - 1], p[i], from);
        const Vec3 v = vector_irradiance(p, from);
        return Truth{angle, dot(v, p[0] - from) > 0 ? v : -v};
    };
    const auto truth_of = [&](std::size_t kind, const Point3& from, double time) {
        const Point3 q{-0.5, 2, -0.25};
        const auto parallelogram = [&](const Vec3& u, const Vec3& v) {
            return polygon({q, q + u, q + u + v, q + v}, from);
        };
        if (kind < 2) return polygon({{-1, kind == 0 ? 1.5 : 2.0, 0}, {1.5, 2, 0.5}, {0, 2.5, 2}}, from);
        if (kind == 2) return parallelogram({2, 0.25, 0}, {0.5, -0.5, 1.5});
        if (kind == 3) return parallelogram({2, 0, 0.5}, {-0.25, 1, 1});
        const bool moving = kind == 7;
        const Vec3 axis = Point3{1, 2, -0.5} + (moving ? time : 0) * Vec3{-2, 0.5, 1} - from;
        const double sine = (moving ? 0.5 : 0.75) / length(axis);
        if (sine > 1) return Truth{4 * kPi, {}};  // inside
        return Truth{2 * kPi * (1 - std::sqrt(1 - sine * sine)), kPi * sine * sine * normalize(axis)};
    };
    for (const std::size_t kind : {0u, 1u, 2u, 3u, 5u, 6u, 7u}) {
        const CompiledScene scene = compile_with(sky(0), {light_of_kind(kind, lamp(3))});
        Random random(40 + kind);
        for (int place = 0; place < 6; ++place) {
            const Point3 from = receiver(random, kind);
            const double time = random.uniform();
            constexpr int kSide = 200, kCount = kSide * kSide;
            double sum = 0, squares = 0;
            Vec3 directions, direction_squares;
            for (int i = 0; i < kCount;
                 ++i) {  // one in each cell of a grid: a bound of plain sampling holds all the more
                const double u = (i % kSide + random.uniform()) / kSide, v = (i / kSide + random.uniform()) / kSide;
                const auto s = sample_light(scene.flat(), {from, {}}, time, random.uniform(), u, v);
                if (!s) continue;
                const double angle = 1 / s->pdf;
                sum += angle, squares += angle * angle;
                for (std::size_t a = 0; a < 3; ++a) {
                    directions[a] += angle * s->direction[a];
                    direction_squares[a] += angle * angle * s->direction[a] * s->direction[a];
                }
            }
            const Truth all = truth_of(kind, from, time);
            const auto check = [&](double total, double total_squares, double truth) {
                const double average = total / kCount;
                const double sigma = std::sqrt(std::max(0.0, total_squares / kCount - average * average) / kCount);
                CHECK(std::abs(average - truth) <= 4.5 * sigma + 1e-9);
                CHECK(sigma <= 0.01 * all.solid_angle);
            };
            CAPTURE(kind, place, all.solid_angle);
            check(sum, squares, all.solid_angle);
            for (std::size_t a = 0; a < 3; ++a) check(directions[a], direction_squares[a], all.direction[a]);
        }
    }
}

TEST_CASE("Light sampling: points are uniform on planar lights, directions in a ball's cone and around its inside",
          "[render][lights]") {
    const Point3 far{0, -1e4, 0};  // from where solid angle and area are as good as the same
    std::mt19937_64 random(41);
    const auto next = [&] { return uniform(random); };
    const auto uv_p = [&](std::size_t kind) {
        const CompiledScene scene = compile_with(sky(0), {light_of_kind(kind, chequered_lamp())});
        return uniform_square_p(kDraws, [&] {
            const double pick = next(), u = next();
            const Uv uv = sample_light(scene.flat(), {far, {}}, 0, pick, u, next())->point.uv;
            // A triangle becomes a square whose sides are a share of its area each.
            const double rest = 1 - uv.u;
            return kind == 0 ? std::pair(1 - rest * rest, uv.v / rest) : std::pair(uv.u, uv.v);
        });
    };
    for (const std::size_t kind : {0u, 2u, 3u}) CHECK(uv_p(kind) > kSamplerLevel);
    const CompiledScene scene = compile_with(sky(0), {light_of_kind(5, lamp(3))});
    for (const Point3& from : {Point3{0, 0, 0}, Point3{1, 2.2, -0.25}}) {
        const Vec3 axis = Point3{1, 2, -0.5} - from;
        const bool inside = length(axis) < 0.75;
        const double angle = inside ? kPi : std::asin(0.75 / length(axis));
        DirectionHistogram histogram(normalize(axis), angle);
        for (int i = 0; i < kDraws; ++i) {
            const double pick = next(), u = next();
            histogram.add(sample_light(scene.flat(), {from, {}}, 0, pick, u, next())->direction);
        }
        const double density = 1 / (2 * kPi * (1 - std::cos(angle)));
        CHECK(histogram.p_value([&](const Vec3&) { return density; }) > kSamplerLevel);
    }
}

TEST_CASE("Light sampling: what is no light, or seen edge-on, has density 0", "[render][lights]") {
    const CompiledScene scene =
        compile_with(sky(0), {ball({0, -9, 0}, 1), quad({0, 1, 0}, {1, 0, 0}, {0, 0, 1}, lamp(1)), ball({9, 0, 0}, 1),
                              quad({4, 1, 0}, {1, 0, 0}, {0.5, 0, 1}, lamp(1)), ball({0, 9, 0}, 1)});
    const Point3 on_quad{0.5, 1, 0.5};
    for (const std::uint64_t number : {0u, 2u, 4u, 1000u}) CHECK(pdf_light(scene.flat(), {}, 0, number, on_quad) == 0);
    CHECK(pdf_light(scene.flat(), {}, 0, 1, on_quad) > 0);
    for (const double pick : {0.1, 0.9})
        CHECK_FALSE(sample_light(scene.flat(), {{-3, 1, 0.25}, {}}, 0, pick, 0.3, 0.6));
    CHECK(pdf_light(scene.flat(), {{-3, 1, 0.25}, {}}, 0, 1, on_quad) == 0);
    CHECK(pdf_light(scene.flat(), {{-3, 1, 0.25}, {}}, 0, 3, on_quad) == 0);
}

}  // namespace limn::light_sampling_test
