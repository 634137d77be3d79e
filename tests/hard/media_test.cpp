// Media against lengths inside their boundaries that are known in closed form, at every size and place.
#include "render/media.h"
#include "hard/hard.h"
#include "limn/math/error.h"
#include "limn/scene/shape/constant_medium.h"
#include "support/pictures.h"

namespace limn::media_test {

using namespace test;
using transport::FreeFlight;
using transport::MediaAlongRay;

namespace {

constexpr double kSizes[] = {1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1, 10, 1e2, 1e3, 1e4, 1e5, 1e6};

// In a body's own space. U as support/meshes.h has it: two arms on a foot.
const std::vector<Box> kCube{{{0, 0, 0}, {1, 1, 1}}};
const std::vector<Box> kU{{{0, 0, 0}, {1, 2, 1}}, {{1, 0, 0}, {2, 1, 1}}, {{2, 0, 0}, {3, 2, 1}}};

// How much of the ray, from its t_min to its t_max and in units of t, lies in boxes that do not overlap.
double inside(const std::vector<Box>& boxes, const Ray& ray) {
    double sum = 0;
    for (const Box& box : boxes) {
        double from = ray.t_min, to = ray.t_max;
        for (std::size_t a = 0; a < 3; ++a) {
            const double low = (box.lower[a] - ray.origin[a]) / ray.direction[a],
                         high = (box.upper[a] - ray.origin[a]) / ray.direction[a];
            from = std::max(from, std::min(low, high)), to = std::min(to, std::max(low, high));
        }
        sum += std::max(0.0, to - from);
    }
    return sum;
}

// The same in a ball of radius 1.
double inside_ball(const Ray& ray) {
    const Vec3 o = ray.origin - Point3{};
    const double d2 = length_squared(ray.direction), foot = -dot(o, ray.direction) / d2;
    const double half = std::sqrt(std::max(0.0, (1 - length_squared(o + foot * ray.direction)) / d2));
    return std::max(0.0, std::min(ray.t_max, foot + half) - std::max(ray.t_min, foot - half));
}

// How far the ends of these lengths move along the ray, at most, where the ray moves sideways by a little: boxes.
double slant(const Ray& ray) {
    const Vec3 d = abs(ray.direction);
    return length(d) / std::min({d.x, d.y, d.z});
}
// The ball, whose chords end ever more slantingly towards its rim; `by`: the little.
double slant_of_ball(const Ray& ray, double by) {
    const Vec3 o = ray.origin - Point3{}, d = normalize(ray.direction);
    const double from_axis = length_squared(o - dot(o, d) * d);
    return 1 / std::sqrt(std::max(std::abs(1 - from_axis), by));
}

using Inside = std::function<double(const Ray&)>;

struct Body {
    std::string name;
    Object object;
    Inside inside;
    Box region;
    std::vector<Point3> points;  // awkward ones of the boundary

    bool is_ball() const { return name.starts_with("ball"); }
    // What the optical depth of a ray of extinction 1 may be off by if coordinates are off by `by`.
    double allowed(const Ray& ray, double by) const {
        return 8 * by * (is_ball() ? slant_of_ball(ray, by) : slant(ray));
    }
};

std::vector<Point3> points_of(const MeshData& mesh) {
    std::vector<Point3> points;
    for (const Index3& f : mesh.triangles) {
        const Point3 a = vertex(mesh, f.a), b = vertex(mesh, f.b);
        points.insert(points.end(), {a, a + 0.5 * (b - a), a + 0.3 * (b - a)});
    }
    return points;
}

std::vector<Body> bodies() {
    const auto in_cube = [](const Ray& ray) { return inside(kCube, ray); };
    const auto in_u = [](const Ray& ray) { return inside(kU, ray); };
    const Box cube{{0, 0, 0}, {1, 1, 1}}, u{{0, 0, 0}, {3, 2, 1}}, ball{{-1, -1, -1}, {1, 1, 1}};
    const std::vector<Point3> cube_points = points_of(cube_mesh()), u_points = points_of(u_shape()),
                              poles{{1, 0, 0}, {0, -1, 0}, {0.6, 0.8, 0}, {0, 0.6, -0.8}, {0, 0, 0}};
    const Object u_mesh = std::make_shared<Mesh>(u_shape(), nullptr), sphere_1 = sphere({0, 0, 0}, 1, nullptr);
    // Two boxes side by side are hit on the wall between them twice, once each way: none of it may be lost.
    const Object halves = std::make_shared<HittableList>(
        std::vector<Object>{make_box({0, 0, 0}, {0.5, 1, 1}, nullptr), make_box({0.5, 0, 0}, {1, 1, 1}, nullptr)});
    return {{"cube of quads", make_box({0, 0, 0}, {1, 1, 1}, nullptr), in_cube, cube, cube_points},
            {"cube of triangles", std::make_shared<Mesh>(cube_mesh(), nullptr), in_cube, cube, cube_points},
            {"two halves of a cube", halves, in_cube, cube, cube_points},
            {"U of triangles", u_mesh, in_u, u, u_points},
            // Of somebody else's shape no more than one face is seen at a place: it must not be hit at an edge.
            {"U of somebody else's class", std::make_shared<Stranger>(u_mesh), in_u, u, {{0.3, 0.1, 0.2}}},
            {"U in a Bvh", std::make_shared<Bvh>(std::vector<Object>{u_mesh}), in_u, u, u_points},
            {"ball", sphere_1, inside_ball, ball, poles},
            {"ball inside out", sphere({0, 0, 0}, -1, nullptr), inside_ball, ball, poles}};
}

Object medium_of(const Object& boundary, double density) {
    return std::make_shared<ConstantMedium>(boundary, density, Color{1, 1, 1});
}

// From inside, from around or from the very boundary, at one of the awkward points or anywhere.
Ray ray_at(Random& random, const Body& body) {
    const Vec3 size = body.region.diagonal();
    Ray ray;
    const Point3 target =
        random.chance(0.6) ? body.points[random.index(body.points.size())] : random.in_box(body.region);
    switch (random.index(3)) {
        case 0: ray.origin = random.in_box(body.region); break;
        case 1: ray.origin = body.region.center() + random.uniform(2, 5) * length(size) * random.unit(); break;
        default: ray.origin = body.points[random.index(body.points.size())]; break;
    }
    ray.direction = target - ray.origin;
    // A ray within a face is as much inside as outside: it must not be aimed along one.
    for (std::size_t a = 0; a < 3; ++a)
        if (ray.direction[a] == 0) ray.direction[a] = random.sign() * random.uniform(0.1, 1);
    ray.direction = std::ldexp(1.0, static_cast<int>(random.index(21)) - 10) * ray.direction;
    if (random.chance(0.3)) ray.t_max = random.uniform(0, 3);
    return ray;
}

// Along the ray by the virtual hit(), one crossing of the boundary after the other; inside before an odd number.
double inside_by_hits(const Object& medium, const Ray& ray) {
    std::vector<double> crossings;
    Ray rest = ray;
    rest.t_max = kInfinity;
    while (const std::optional<Hit> hit = medium->hit(rest)) crossings.push_back(rest.t_min = hit->t);
    double sum = 0;
    for (std::size_t i = 0; i < crossings.size(); ++i) {
        if ((crossings.size() - i) % 2 == 0) continue;
        sum += std::max(0.0, std::min(crossings[i], ray.t_max) - (i == 0 ? ray.t_min : crossings[i - 1]));
    }
    return sum;
}

struct Depths {
    Tally tally;
    MediaAlongRay media;

    // `depth` the true optical depth of the ray, `allowed` the rounding of its length.
    void judge(const CompiledScene& scene, const Ray& ray, double depth, double allowed, double random) {
        ++tally.rays, ++tally.judged;
        media.trace(scene.flat(), ray);
        const double found = -std::log(media.transmittance());
        if (!(std::abs(found - depth) <= allowed)) return tally.fault(ray, "depth " + std::to_string(found - depth));
        const double drawn = -std::log1p(-random);
        const FreeFlight flight = media.sample(drawn, 0.5);
        if (std::abs(drawn - depth) > allowed && flight.scatters != (drawn < depth))
            tally.fault(ray, "flight of depth " + std::to_string(drawn));
    }
};

}  // namespace

TEST_CASE("Media: of a boundary of any size and place no stretch is lost, wherever rays cross it", "[hard][media]") {
    const int rays = std::max(1, count(1e7) / static_cast<int>(bodies().size() * std::size(kSizes) * 3));
    for (const Body& body : bodies())
        for (const double size : kSizes)
            for (const double away : {0.0, 10.0, 1e3}) {
                const Vec3 at = away * size * Vec3{1, -1, 0.5};
                const Object placed = std::make_shared<Instance>(
                    body.object, Transform::translate(at) * Transform::scale(size, size, size));
                const CompiledScene scene = compile_with(sky(0), {medium_of(placed, 1 / size)});
                Random random(50 + static_cast<std::uint64_t>(away));
                Depths depths;
                for (int i = 0; i < rays; ++i) {
                    const Ray own = ray_at(random, body);
                    Ray ray = own;
                    ray.origin = Point3{} + at + size * (own.origin - Point3{}), ray.direction = size * own.direction;
                    const double by = gamma(16) * (20 + 2 * away);  // the ray's coordinates are rounded at its place
                    depths.judge(scene, ray, body.inside(own) * length(own.direction), body.allowed(own, by),
                                 random.uniform());
                }
                check(depths.tally, body.name + ", size " + std::to_string(size) + ", away " + std::to_string(away));
            }
}

TEST_CASE("Media: the described boundary, hit after hit, has the same length inside", "[hard][media]") {
    for (const Body& body : bodies()) {
        if (body.name == "two halves of a cube") continue;  // the wall between is hit once of two times
        const Object medium = medium_of(body.object, 1);
        const CompiledScene scene = compile_with(sky(0), {medium});
        Random random(51);
        Depths depths;
        for (int i = 0; i < count(1e6) / 8; ++i) {
            Ray ray = ray_at(random, body);
            ray.origin = random.in_box(body.region);  // no vertices: hit after hit cannot see two at one place
            ray.direction = random.log_uniform(1e-3, 1e3) * random.unit();
            depths.judge(scene, ray, inside_by_hits(medium, ray) * length(ray.direction), 1e-9, random.uniform());
        }
        check(depths.tally, body.name);
    }
}

TEST_CASE("Media: where boundaries overlap in any number the depths add up, and a flight ends by their sum",
          "[hard][media]") {
    std::vector<Body> all = bodies();
    std::erase_if(all, [](const Body& body) { return body.points.size() == 1; });  // somebody else's
    for (int scene_number = 0; scene_number < 20; ++scene_number) {
        Random random(54 + static_cast<std::uint64_t>(scene_number));
        std::vector<const Body*> chosen;
        std::vector<double> densities;
        std::vector<Object> media;
        for (std::size_t i = 0; i < 2 + random.index(6); ++i) {
            chosen.push_back(&all[random.index(all.size())]);  // some of them twice
            densities.push_back(random.log_uniform(1e-3, 3));
            media.push_back(medium_of(chosen.back()->object, densities.back()));
        }
        const CompiledScene scene = compile_with(sky(0), media);
        Depths depths;
        for (int i = 0; i < count(1e6) / 20; ++i) {
            const Ray ray = ray_at(random, *chosen.front());
            double depth = 0, allowed = 1e-12;
            for (std::size_t k = 0; k < chosen.size(); ++k) {
                depth += densities[k] * chosen[k]->inside(ray) * length(ray.direction);
                allowed += densities[k] * chosen[k]->allowed(ray, gamma(16) * 20);
            }
            depths.judge(scene, ray, depth, allowed, random.uniform());
        }
        check(depths.tally, "scene " + std::to_string(scene_number));
    }
}

TEST_CASE("Media: extinctions that add up beyond the largest double stop all light and leave none behind them",
          "[hard][media]") {
    // 1e308 along a direction of length 1e10, twice: the shadow ray of a light far away.
    const Object cube = make_box({1, -1, -1}, {2, 1, 1}, nullptr);
    for (const double density : {1e30, 1e300, 1.7e308}) {
        const CompiledScene scene = compile_with(
            sky(0), {medium_of(cube, density), medium_of(cube, density),
                     medium_of(make_box({1.5, -1, -1}, {3, 1, 1}, nullptr), density), medium_of(cube, 5e-324)});
        for (const double speed : {1e-30, 1.0, 1e10, 1e300}) {
            MediaAlongRay media;
            for (const double y : {0.0, 0.5, 1.0}) {
                media.trace(scene.flat(), {.origin = {0, y, 0}, .direction = {speed, 0, 0}});
                CAPTURE(density, speed, y);
                if (y == 1.0) {  // along a face: inside or outside, but a number
                    CHECK((media.transmittance() >= 0 && media.transmittance() <= 1));
                    continue;
                }
                CHECK(media.transmittance() == 0);
                for (const double random : {0.0, 0.5, 1 - 0x1p-53}) {
                    const FreeFlight flight = media.sample(-std::log1p(-random), random);
                    REQUIRE(flight.scatters);
                    CHECK(flight.t == Approx(1 / speed).epsilon(1e-12));
                }
            }
            media.trace(scene.flat(), {.origin = {0, 2, 0}, .direction = {speed, 0, 0}});
            CHECK(media.transmittance() == 1);
            CHECK_FALSE(media.sample(53 * std::log(2.0), 0.5).scatters);
        }
    }
}

TEST_CASE("Media: a density that is negative, infinite or no number is refused", "[hard][media]") {
    const Object boundary = sphere({0, 0, 0}, 1, nullptr);
    for (const double density : {-1e-300, -5e-324, -1.0, kInfinity, -kInfinity, std::nan("")})
        CHECK_THROWS_AS(medium_of(boundary, density), ArgumentError);
    CHECK_NOTHROW(medium_of(boundary, -0.0));
}

}  // namespace limn::media_test
