// Transmittance exp(-sigma l) through media of every shape, from outside and inside.
#include "catch.h"
#include "limn/scene/texture/checker.h"
#include "support/pictures.h"

namespace limn::media_test {

using namespace test;

namespace {

const Color kBlack{0, 0, 0};
// What the boundaries are made of must not show; a lamp would show most.
const MaterialPtr kBoundary = lamp(100);

Object smoke(Object boundary, double density) {
    return std::make_shared<ConstantMedium>(std::move(boundary), density, kBlack);
}
Object list_of(std::vector<Object> objects) { return std::make_shared<HittableList>(std::move(objects)); }

// The share of light that passes along one ray through absorbing media before a white sky: a coin a sample.
void check_transmittance(const std::vector<Object>& objects, const Point3& from, const Point3& at, double truth,
                         int max_depth = 1) {
    RenderSettings settings = square(16, 256, max_depth);
    settings.antialias = false;
    Camera camera = camera_at(from, at, 1e-9);  // all pixels see the same
    const double samples = 16 * 16 * 256;
    const double passed = mean(render(compile_with(sky(1), objects), camera, settings).image);
    const double sigma = std::sqrt(truth * (1 - truth) / samples);
    INFO("passed " << passed << " of " << truth << " +- " << sigma);
    CHECK(std::abs(passed - truth) <= 4.5 * sigma + 1e-6);
}

// Light through a medium from a small far lamp onto a floor, by light sampling: no coin, so a sharp test.
double lit_through(const std::vector<Object>& media, double scale, const Vec3& shift) {
    const Point3 o = Point3{} + shift;
    std::vector<Object> objects{
        quad(o - Vec3{50 * scale, 0, 50 * scale}, {0, 0, 100 * scale}, {100 * scale, 0, 0}, grey(0.5)),
        sphere(o + Vec3{0, 1e4 * scale, 0}, scale, lamp(1e8))};
    objects.insert(objects.end(), media.begin(), media.end());
    const Camera camera = camera_at(o + Vec3{0, 0.2 * scale, 0.1 * scale}, o, 0.01);
    return mean(render(compile_with(sky(0), objects), camera, square(8, 16, 2)).image) / 0.5;
}

}  // namespace

TEST_CASE("Media: a cube of size s and extinction 1/s passes 1/e, for s from 1e-5 to 1e6, near and far",
          "[render][media]") {
    for (const double s : {1e-5, 1e-3, 1.0, 1e3, 1e6}) {
        for (const double shift : {0.0, 1e3}) {
            const Vec3 at = shift * s * Vec3{1, 1, 0};
            const Object cube = make_box(Point3{} + at, Point3{} + at + Vec3{s, s, s}, kBoundary);
            INFO("size " << s << ", shift " << shift);
            const Point3 through = Point3{} + at + Vec3{0.3 * s, 0.4 * s, 0.5 * s};
            check_transmittance({smoke(cube, 1 / s)}, through + Vec3{0, 0, 5 * s}, through, std::exp(-1));
            const Object slab = make_box(Point3{} + at + Vec3{-60 * s, s, -60 * s},
                                         Point3{} + at + Vec3{60 * s, 2 * s, 60 * s}, kBoundary);
            // The lamp's radius lets the lit path lean by 1e-4: 5e-9 longer at most.
            CHECK(lit_through({smoke(slab, 1 / s)}, s, at) == Approx(std::exp(-1)).epsilon(1e-4));
        }
    }
}

TEST_CASE("Media: a ball of smoke has the exact transmittance of its chords, at depth 1", "[render][media]") {
    const Object ball = sphere({0, 0, 0}, 1, kBoundary);
    check_transmittance({smoke(ball, 1)}, {0, 0, 10}, {0, 0, 0}, std::exp(-2));
    check_transmittance({smoke(ball, 1)}, {0, 0.6, 10}, {0, 0.6, 0}, std::exp(-1.6));
    // The whole frame of vfov 20 from 10 away: .820832.
    check_mean(measure(compile_with(sky(1), {smoke(ball, 1)}), camera_at({0, 0, 10}, {0, 0, 0}, 20), square(40, 16, 1)),
               0.820832, 1e-3);
}

TEST_CASE("Media: from inside, what is left of the way counts, and for lamps inside, the way to them",
          "[render][media]") {
    const Object ball = sphere({0, 0, 0}, 2, kBoundary);
    check_transmittance({smoke(ball, 0.7)}, {0, 0, 0.5}, {0, 0, 0}, std::exp(-0.7 * 2.5));
    check_transmittance({smoke(std::make_shared<Mesh>(cube_mesh(4, {-2, -2, -2}), kBoundary), 0.7)}, {0.1, 0.2, 0.5},
                        {0.1, 0.2, 0}, std::exp(-0.7 * 2.5));
    check_transmittance({smoke(ball, 0.7), sphere({0, 0, 0}, 0.5, lamp(1))}, {0, 0, 10}, {0, 0, 0},
                        std::exp(-0.7 * 1.5));
    check_transmittance({smoke(ball, 0.7), sphere({0, 0, 0}, 0.5, lamp(1))}, {0, 0, 1.5}, {0, 0, 0}, std::exp(-0.7));
}

TEST_CASE("Media: boundaries that are not convex, hollow or in pieces count each stretch", "[render][media]") {
    const Object u = std::make_shared<Mesh>(u_shape(), kBoundary);  // arms [0,1] and [2,3] in x above y = 1
    check_transmittance({smoke(u, 0.5)}, {10, 1.6, 0.4}, {0, 1.6, 0.4}, std::exp(-0.5 * 2));
    check_transmittance({smoke(u, 0.5)}, {10, 0.4, 0.4}, {0, 0.4, 0.4}, std::exp(-0.5 * 3));
    check_transmittance({smoke(u, 0.5)}, {1.5, 1.6, 0.4}, {0, 1.6, 0.4}, std::exp(-0.5));          // eye in the slot
    check_transmittance({smoke(u, 0.5)}, {2.75, 1.6, 0.4}, {0, 1.6, 0.4}, std::exp(-0.5 * 1.75));  // eye in an arm
    for (const double inner : {0.5, -0.5}) {
        const Object shell = list_of({sphere({0, 0, 0}, 1, kBoundary), sphere({0, 0, 0}, inner, kBoundary)});
        check_transmittance({smoke(shell, 1)}, {0, 0, 5}, {0, 0, 0}, std::exp(-1));
        check_transmittance({smoke(shell, 1)}, {0, 0, 0.1}, {0, 0, 0}, std::exp(-0.5));  // eye in the hollow
        check_transmittance({smoke(shell, 1)}, {0, 0.7, 5}, {0, 0.7, 0}, std::exp(-2 * std::sqrt(0.51)));  // beside it
    }
    const Object two = list_of({sphere({0, 0, 0}, 1, kBoundary), sphere({0, 0, 5}, 0.5, kBoundary)});
    check_transmittance({smoke(two, 0.5)}, {0, 0, 10}, {0, 0, 0}, std::exp(-0.5 * 3));
    check_transmittance({smoke(std::make_shared<Stranger>(two), 0.5)}, {0, 0, 10}, {0, 0, 0}, std::exp(-0.5 * 3));
    check_transmittance({smoke(std::make_shared<Bvh>(std::vector<Object>{two, sphere({9, 9, 9}, 1, kBoundary)}), 0.5)},
                        {0, 0, 10}, {0, 0, 0}, std::exp(-0.5 * 3));
}

TEST_CASE("Media: a ray through a vertex or along an edge of the boundary is inside or outside like its neighbours",
          "[render][media]") {
    const MeshData ball = icosphere(1, 1);
    const Object mesh = std::make_shared<Mesh>(ball, kBoundary);
    for (const std::uint32_t i : {0u, 5u, 20u}) {
        // Through the centre: from a vertex to the one opposite, both at distance 1.
        const Point3 v = vertex(ball, i);
        check_transmittance({smoke(mesh, 1)}, Point3{} + 10 * (v - Point3{}), {0, 0, 0}, std::exp(-2));
    }
    const Object cube = std::make_shared<Mesh>(cube_mesh(), kBoundary);
    check_transmittance({smoke(cube, 1)}, {2, 2, 2}, {0.5, 0.5, 0.5}, std::exp(-std::sqrt(3.0)));  // corner to corner
    check_transmittance({smoke(cube, 1)}, {0.5, 0.5, 3}, {0.5, 0.5, 0}, std::exp(-1));  // along the diagonals
    check_transmittance({smoke(make_box({0, 0, 0}, {1, 1, 1}, kBoundary), 1)}, {2, 2, 2}, {0.5, 0.5, 0.5},
                        std::exp(-std::sqrt(3.0)));
    check_transmittance({smoke(cube, 1)}, {2, 0, 0.5}, {0, 2, 0.5}, 1);  // touches the edge x = y = 1 alone
}

TEST_CASE("Media: extinction is by world length, whatever instance the medium stands in", "[render][media]") {
    const Object ball = sphere({0, 0, 0}, 1, kBoundary);
    const Transform wide = Transform::translate({5, 0, 0}) * Transform::scale(3, 1, 2);
    check_transmittance({std::make_shared<Instance>(smoke(ball, 0.4), wide)}, {15, 0, 0}, {5, 0, 0},
                        std::exp(-0.4 * 6));
    check_transmittance({smoke(std::make_shared<Instance>(ball, wide), 0.4)}, {15, 0, 0}, {5, 0, 0},
                        std::exp(-0.4 * 6));
    check_transmittance(
        {std::make_shared<Instance>(std::make_shared<Instance>(smoke(ball, 0.4), Transform::rotate_y(90)),
                                    Transform::scale(2, 2, 2))},
        {15, 0, 0}, {0, 0, 0}, std::exp(-0.4 * 4));
    check_transmittance({std::make_shared<Instance>(smoke(ball, 0.4), Transform::scale(-3, 1, 1))}, {15, 0, 0},
                        {0, 0, 0}, std::exp(-0.4 * 6));
    // Moving: in the way for a part of the shutter.
    const Transform away = Transform::translate({0, 4, 0});
    check_transmittance({std::make_shared<Instance>(smoke(ball, 100), Transform{}, away)}, {15, 0, 0}, {0, 0, 0}, 0.75,
                        1);  // within 1 of the axis for a quarter of the time, and smoke as good as black
}

TEST_CASE("Media: overlapping extinctions add up", "[render][media]") {
    const Object a = sphere({0, 0, 0}, 1, kBoundary), b = make_box({-2, -2, -1}, {2, 2, 1}, kBoundary);
    check_transmittance({smoke(a, 0.3), smoke(b, 0.4)}, {0, 0, 10}, {0, 0, 0}, std::exp(-0.7 * 2));
    check_transmittance({smoke(a, 0.3), smoke(a, 0.4), smoke(a, 0.3)}, {0, 0, 10}, {0, 0, 0}, std::exp(-1.0 * 2));
    check_transmittance({smoke(a, 0.5), smoke(sphere({0, 0, 1}, 1, kBoundary), 0.5)}, {0, 0, 10}, {0, 0, 0},
                        std::exp(-0.5 * 4));
    check_transmittance({smoke(a, 0.3), smoke(b, 0.4)}, {0, 0, 0.5}, {0, 0, 0}, std::exp(-0.7 * 1.5));  // eye in both
}

TEST_CASE("Media: one medium alone or beside others in a list or Bvh passes the same", "[render][media]") {
    const Object fog = smoke(sphere({0, 0, 0}, 1, kBoundary), 1);
    std::vector<Object> objects{fog};
    for (int i = 0; i < 4; ++i) {
        for (const Object& holder : {list_of(objects), Object(std::make_shared<Bvh>(objects))})
            check_transmittance({holder}, {0, 0, 10}, {0, 0, 0}, std::exp(-2));
        objects.push_back(sphere({9 + 3.0 * i, 0, 0}, 1, grey(0.5)));
    }
}

TEST_CASE("Media: extinction 0 and 1e-30 are invisible, 1e30 passes nothing, and nothing is NaN", "[render][media]") {
    const Object ball = sphere({0, 0, 0}, 1, kBoundary);
    const Camera camera = camera_at({0, 0, 10}, {0, 0, 0}, 8);
    for (const double density : {0.0, 1e-30}) {
        const Image image = render(compile_with(sky(1), {smoke(ball, density)}), camera, square(8, 64, 10)).image;
        for (const float v : image.values()) CHECK(v == 1.0f);
    }
    const RenderResult thick = render(compile_with(sky(1), {smoke(ball, 1e30)}), camera, square(8, 64, 10));
    for (const float v : thick.image.values()) CHECK(v == 0.0f);
    // Scattering: what enters comes out again.
    const Object white = std::make_shared<ConstantMedium>(ball, 1e30, Color{1, 1, 1});
    const RenderResult milk = render(compile_with(sky(1), {white}), camera, square(4, 64, kUnlimitedDepth));
    CHECK(milk.report.nonfinite_samples == 0);
    for (const float v : milk.image.values()) CHECK(std::isfinite(v));
}

TEST_CASE("Media: a surface exactly on the boundary is lit through the medium and seen through it", "[render][media]") {
    // The floor is the slab's lower face; the lamp far above; e^-1 on the way down.
    const Object slab = make_box({-60, 0, -60}, {60, 1, 60}, kBoundary);
    CHECK(lit_through({smoke(slab, 0)}, 1, {}) == Approx(1).epsilon(1e-4));
    // The eye is .2 above and .1 beside: sqrt(.05) of its own way is in the smoke too.
    const Object floor = quad({-50, 0, -50}, {0, 0, 100}, {100, 0, 0}, grey(0.5));
    const Object sun = sphere({0, 1e4, 0}, 1, lamp(1e8));
    const CompiledScene scene = compile_with(sky(0), {floor, sun, smoke(slab, 1)});
    const double truth = 0.5 * std::exp(-1) * std::exp(-2);
    check_mean(measure(scene, camera_at({0, 2, std::sqrt(3.0) * 2}, {0, 0, 0}, 0.01), square(8, 256, 2)), truth, 5e-3);
}

TEST_CASE("Media: where media overlap each scatters in proportion to its extinction", "[render][media]") {
    // Black smoke of extinction s beside white fog of extinction 3 s: three of four events scatter. One order only.
    const Object ball = sphere({0, 0, 0}, 1, kBoundary);
    const auto once = [&](const std::vector<Object>& media) {
        return measure(compile_with(sky(1), media), camera_at({0, 0, 8}, {0, 0, 0}, 10), square(16, 64, 2)).mean;
    };
    const auto medium = [&](double density, double albedo) {
        return std::make_shared<ConstantMedium>(ball, density, Color{albedo, albedo, albedo});
    };
    const double black = once({medium(4, 0)}), both = once({medium(1, 0), medium(3, 1)}),
                 mixed = once({medium(4, 0.75)});
    CHECK(both > black + 0.05);
    CHECK(both == Approx(mixed).epsilon(5e-3));
}

TEST_CASE("Media: a textured albedo is looked up where the light scatters", "[render][media]") {
    // Left half white, right half black, before a black sky with a lamp around: the right half stays dark at one order.
    const auto halves = std::make_shared<Checker>(100, Color{0, 0, 0}, Color{1, 1, 1});  // x < 0: odd cell
    const Object fog = std::make_shared<ConstantMedium>(make_box({-1, 1, 1}, {1, 3, 3}, kBoundary), 2, halves);
    const CompiledScene scene = compile_with(sky(1), {fog});
    const auto at = [&](double x) {
        return mean(render(scene, camera_at({x, 2, 20}, {x, 2, 0}, 0.1), square(8, 256, 2)).image);
    };
    CHECK(at(0.5) == Approx(std::exp(-4.0)).margin(0.006));
    CHECK(at(-0.5) > 0.2);
}

}  // namespace limn::media_test
