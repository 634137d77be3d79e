// Every special double in every field of a ray, a shape, a matrix: what cannot be used misses or is refused, all else
// is answered exactly, and nothing aborts. Among them spheres of negative and no radius, triangles without area, quads
// with parallel edges, and rays of NaN, infinities and no direction.
#include <bit>

#include "catch.h"
#include "hard/placed.h"
#include "hard/special_values.h"
#include "limn/math/error.h"

namespace limn::bad_values_test {

using namespace test;

namespace {

double& field(Ray& ray, std::size_t i) {
    if (i < 3) return ray.origin[i];
    if (i < 6) return ray.direction[i - 3];
    return i == 6 ? ray.t_min : i == 7 ? ray.t_max : ray.time;
}
constexpr std::size_t kRayFields = 9;

template <class... Arrays>
std::vector<double> joined(const Arrays&... arrays) {
    std::vector<double> all;
    (all.insert(all.end(), arrays.begin(), arrays.end()), ...);
    return all;
}

std::vector<Placed> shapes() {
    const Transform turned = Transform::translate({0.5, -0.25, 1}) * Transform::rotate({1, 2, 3}, 40);
    const MeshData cube = cube_mesh(2, {-1, -1, -1});
    std::vector<Placed> all{
        {.kind = Placed::Kind::sphere, .p = {0.1, 0.2, 0.3}, .radius = 1.5},
        {.kind = Placed::Kind::triangle, .p = {-1, -1, 0.5}, .e = {3, 0.25, 0}, .f = {0.5, 3, 0.125}},
        {.kind = Placed::Kind::quad, .p = {-1, -1, -0.5}, .e = {2, 0, 0.5}, .f = {0, 2, 0}},
        {.kind = Placed::Kind::mesh, .mesh = cube},
    };
    for (std::size_t i = 0; i < 4; ++i) {
        all.push_back(all[i]);
        all.back().chain = {turned, Transform::scale(1, -0.5, 2)};
    }
    return all;
}

// What a scene of one shape answers in either world, where it is only asked not to falter.
void survives(const Object& object, const BothWorlds& worlds, const Ray& ray, Tally& tally) {
    ++tally.rays, ++tally.judged;
    const auto hit = worlds.hit(ray, tally);
    if (!hit) return;
    ++tally.hits;
    if (!(hit->t > ray.t_min && hit->t <= ray.t_max && std::isfinite(hit->t)))
        tally.fault(ray, "t outside its interval");
    if (std::isnan(hit->u) || std::isnan(hit->v)) tally.fault(ray, "u, v");
    if (!object->hit(ray)) tally.fault(ray, "not twice the same");
}

}  // namespace

TEST_CASE(
    "Bad rays: a special value in every field, alone or in pairs: unusable rays miss, all others are answered "
    "exactly",
    "[hard][bad]") {
    const std::vector<double> values = joined(kFiniteValues, kUnusableValues);
    for (const Placed& placed : shapes()) {
        const BothWorlds worlds(placed.object(), {ball({0, 0, -1e6}, 1), ball({1e30, 0, 0}, 1e20)});
        Tally tally;
        std::uint64_t unusable = 0, expected = 0;
        const auto ask = [&](const Ray& ray) {
            judge(tally, placed, worlds, ray);
            if (is_usable(ray)) return;
            ++unusable;
            if (worlds.hit(ray, tally)) tally.fault(ray, "an unusable ray hits");
        };
        Random random(3200);
        Ray good{.origin = {0.25, 0.5, 5}, .direction = {0, 0, 0}};
        good.direction = placed.point_on(random, false) - good.origin;
        for (std::size_t i = 0; i < kRayFields; ++i)
            for (const double value : values) {
                Ray ray = good;
                field(ray, i) = value;
                ask(ray);
                // NaN everywhere; infinities but at the right ends of the interval; an interval of nothing.
                const bool good_end = (i == 6 && value == -kInfinity) || (i == 7 && value == kInfinity);
                expected += (!std::isfinite(value) && !good_end) || (i == 7 && value < 0);
            }
        CHECK(unusable == expected);
        for (int i = 0; i < count(1e6) / 2; ++i) {
            Ray ray = good;
            for (std::size_t k = 0; k <= random.index(4); ++k)
                field(ray, random.index(kRayFields)) = values[random.index(values.size())];
            ask(ray);
        }
        check(tally, "kind " + std::to_string(static_cast<int>(placed.kind)));
        CHECK(tally.hits > tally.rays / 20);
    }
}

TEST_CASE("Bad rays: from as far as 3e38, aimed at the shape by a direction of any length, the answer is exact",
          "[hard][bad]") {
    for (const Placed& placed : shapes()) {
        const BothWorlds worlds(placed.object(), {ball({0, 0, -1e6}, 1)});
        const std::vector<Point3> points = placed.awkward_points();
        Random random(3210);
        Tally tally;
        for (int i = 0; i < count(1e5); ++i) {
            const Point3 target =
                random.chance(0.5) ? points[random.index(points.size())] : placed.point_on(random, random.chance(0.5));
            const double distance = random.log_uniform(1e3, 1e38);
            Ray ray;
            ray.origin = target + distance * random.unit();
            ray.direction = target - ray.origin;
            if (random.chance(0.5)) {  // along an axis, where doubles still reach the shape
                const std::size_t axis = random.index(3);
                for (std::size_t a = 0; a < 3; ++a) ray.origin[a] = a == axis ? distance : target[a];
                ray.direction = {0, 0, 0};
                ray.direction[axis] = -1;
            }
            ray.direction = (random.log_uniform(1e-280, 1e240) / max_abs(ray.direction)) * ray.direction;
            if (ray.direction == Vec3{}) ray.direction.x = 5e-324;
            judge(tally, placed, worlds, ray);
        }
        check(tally, "kind " + std::to_string(static_cast<int>(placed.kind)));
        CHECK(tally.hits > tally.rays / 10);
    }
}

TEST_CASE("Bad rays: beyond 3e38 neither world falters, and they agree", "[hard][bad]") {
    const std::vector<double> values = joined(kFiniteValues, kHugeValues, kUnusableValues);
    for (const Placed& placed : shapes()) {
        const Object object = placed.object();
        const BothWorlds worlds(object, {ball({0, 0, -1e6}, 1)});
        Random random(3220);
        Tally tally;
        for (int i = 0; i < count(1e6); ++i) {
            Ray ray{.origin = {0.25, 0.5, 5}, .direction = {-0.05, -0.1, -1}};
            for (std::size_t k = 0; k <= random.index(7); ++k)
                field(ray, random.index(kRayFields)) = values[random.index(values.size())];
            survives(object, worlds, ray, tally);
        }
        check(tally, "kind " + std::to_string(static_cast<int>(placed.kind)));
    }
}

TEST_CASE("Bad geometry: a special value in every field of a sphere, triangle or quad is refused or answered exactly",
          "[hard][bad]") {
    const std::vector<double> values = joined(kFiniteValues, kUnusableValues);
    for (const Placed::Kind kind : {Placed::Kind::sphere, Placed::Kind::triangle, Placed::Kind::quad}) {
        Random random(3230);
        Tally tally;
        int refused = 0, accepted = 0;
        for (int i = 0; i < count(1e6) / 2; ++i) {
            Placed placed{.kind = kind, .p = {-0.5, -0.25, 0.5}, .e = {2, 0.25, 0}, .f = {0.5, 2, 0.125}};
            if (i < 4 * static_cast<int>(values.size())) {  // each field alone first
                const std::size_t which = static_cast<std::size_t>(i) / values.size();
                const double value = values[static_cast<std::size_t>(i) % values.size()];
                (which == 0 ? placed.p.x : which == 1 ? placed.e.y : which == 2 ? placed.f.z : placed.radius) = value;
            }
            for (std::size_t k = 0; k < random.index(5); ++k) {
                const double value = values[random.index(values.size())];
                const std::size_t axis = random.index(3);
                switch (random.index(4)) {
                    case 0: placed.p[axis] = value; break;
                    case 1: placed.e[axis] = value; break;
                    case 2: placed.f[axis] = value; break;
                    default: placed.radius = value; break;
                }
            }
            const Point3 b = placed.p + placed.e, c = placed.p + placed.f;
            const bool finite = is_finite(placed.p) && is_finite(placed.e) && is_finite(placed.f);
            const bool good = kind == Placed::Kind::sphere
                                  ? is_finite(placed.p) && std::isfinite(placed.radius) && placed.radius != 0
                              : kind == Placed::Kind::triangle
                                  ? is_finite(placed.p) && is_finite(b) && is_finite(c) && !exactly_flat(placed.p, b, c)
                                  : finite && !exactly_flat({0, 0, 0}, Point3{} + placed.e, Point3{} + placed.f);
            if (!good) {
                ++refused;
                CHECK_THROWS_AS(placed.shape(), ArgumentError);
                continue;
            }
            ++accepted;
            const BothWorlds worlds(placed.shape());
            const std::vector<Point3> points = placed.awkward_points();
            for (int k = 0; k < 4; ++k) {
                Ray ray{.origin = {0.25, 0.5, 5}, .direction = {-0.05, -0.1, -1}};
                if (k == 1) ray.direction = points[random.index(points.size())] - ray.origin;
                if (k == 2) ray.origin = points[random.index(points.size())];
                if (k == 3) field(ray, random.index(6)) = values[random.index(kFiniteValues.size())];
                judge(tally, placed, worlds, ray);
            }
        }
        check(tally, "kind " + std::to_string(static_cast<int>(kind)));
        CHECK(refused > 100);
        CHECK(accepted > 100);
        CHECK(tally.hits > tally.rays / 20);
    }
}

TEST_CASE("Bad geometry: a special value in every entry of a matrix is refused or the instance is answered exactly",
          "[hard][bad]") {
    const std::vector<double> values = joined(kFiniteValues, kUnusableValues);
    Tally tally;
    Random random(3240);
    int refused = 0, accepted = 0;
    for (int i = 0; i < count(1e6) / 2; ++i) {
        Placed placed{.kind = static_cast<Placed::Kind>(random.index(3)), .p = {-0.5, -0.25, 0.5}};
        placed.e = {2, 0.25, 0}, placed.f = {0.5, 2, 0.125};
        Transform m = Transform::rotate({1, 2, 3}, 33);
        const std::size_t first = random.index(3), second = random.index(4);
        m.rows[first][second] = values[static_cast<std::size_t>(i) % values.size()];
        if (random.chance(0.5)) m.rows[random.index(3)][random.index(4)] = values[random.index(values.size())];
        placed.chain = {m};
        Object object;
        try {
            object = placed.object();
        } catch (const ArgumentError&) {
            ++refused;
            continue;
        }
        ++accepted;
        CHECK(is_finite(m));
        const BothWorlds worlds(object);
        const std::vector<Point3> points = placed.awkward_points();
        for (int k = 0; k < 4; ++k) {
            const Point3 target = points[random.index(points.size())];
            Ray ray{.origin = {0.25, 0.5, 5}, .direction = {-0.05, -0.1, -1}};
            if (k > 0 && is_finite(target)) ray.direction = target - ray.origin;
            if (k == 2) ray.origin = ray.origin - ray.direction;
            if (k == 3 && is_finite(target)) ray.origin = target;
            if (!is_usable(ray)) ray = {.origin = {0, 0, 5}, .direction = {0, 0, -1}};
            judge(tally, placed, worlds, ray);
        }
    }
    check(tally, "matrices");
    CHECK(refused > 100);
    CHECK(accepted > 100);
    CHECK(tally.hits > tally.rays / 20);
}

TEST_CASE(
    "Bad geometry: of a mesh with every special float32 in every vertex the flat triangles are dropped and "
    "counted, the others are answered exactly",
    "[hard][bad]") {
    const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    const float values[] = {0,  -0.0f, 0x1p-149f, -0x1p-149f, 1e-40f, 0x1p-126f, 1e-30f,          1e-7f, 0.5f, 1,
                            -1, 1e7f,  -1e15f,    1e25f,      3e38f,  -3e38f,    0x1.fffffep127f, nan,   inf,  -inf};
    Random random(3250);
    Tally tally;
    int refused = 0, accepted = 0;
    for (int i = 0; i < count(1e6) / 2; ++i) {
        Placed placed{.kind = Placed::Kind::mesh, .mesh = cube_mesh(2, {-1, -1, -1})};
        for (std::size_t k = 0; k <= random.index(3); ++k) {
            Float3& p = placed.mesh.vertices[random.index(8)];
            const float value = values[random.index(std::size(values))];
            const std::size_t axis = random.index(3);
            (axis == 0 ? p.x : axis == 1 ? p.y : p.z) = value;
        }
        bool finite = true;
        for (const Float3& p : placed.mesh.vertices)
            finite = finite && std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
        if (!finite) {
            ++refused;
            CHECK_THROWS_AS(placed.shape(), ArgumentError);
            continue;
        }
        ++accepted;
        std::size_t flat = 0;
        for (const Index3& t : placed.mesh.triangles)
            flat += exactly_flat(vertex(placed.mesh, t.a), vertex(placed.mesh, t.b), vertex(placed.mesh, t.c));
        const auto mesh = std::make_shared<Mesh>(placed.mesh, nullptr);
        if (mesh->degenerate_triangles() != flat) tally.fault({.origin = {0, 0, 0}, .direction = {0, 0, 1}}, "count");
        const BothWorlds worlds(mesh);
        const std::vector<Point3> points = placed.awkward_points();
        for (int k = 0; k < 3; ++k) {
            Ray ray{.origin = {0.25, 0.5, 5}, .direction = {-0.05, -0.1, -1}};
            if (k == 1) ray.direction = points[random.index(points.size())] - ray.origin;
            if (k == 2) ray.origin = placed.point_on(random, true);
            judge(tally, placed, worlds, ray);
        }
    }
    check(tally, "meshes");
    CHECK(refused > 100);
    CHECK(accepted > 100);
    CHECK(tally.hits > tally.rays / 20);
}

TEST_CASE("Bad background: a value that is negative or not finite is refused by the name of its end, all others render",
          "[hard][bad]") {
    for (const double value : joined(kFiniteValues, kHugeValues, kUnusableValues))
        for (const bool is_top : {false, true})
            for (double Color::*channel : {&Color::r, &Color::g, &Color::b}) {
                Scene scene;
                Color& end = is_top ? scene.background.top : scene.background.bottom;
                end.*channel = value;
                CAPTURE(value, is_top);
                if (std::isfinite(value) && value >= 0) {
                    CHECK_NOTHROW(compile(scene));
                    continue;
                }
                CHECK_THROWS_WITH(compile(scene), Catch::Contains(is_top ? "background.top" : "background.bottom"));
                CHECK_THROWS_AS(compile(scene), ArgumentError);
            }
}

TEST_CASE("Bad rays: in a whole scene unusable rays miss, one by one and in a batch, and are as many as expected",
          "[hard][bad]") {
    const CompiledScene scene = compile(zoo_instances().scene);
    std::vector<Ray> rays = unusable_rays();
    const std::size_t bad = rays.size();
    for (std::size_t i = 0; i < bad; ++i) rays.push_back({.origin = {0, 0, 5}, .direction = {0, 0, -1}});
    std::vector<RayHit> hits(rays.size());
    std::vector<std::uint8_t> any(rays.size());
    scene.closest_hit(rays, hits);
    scene.any_hit(rays, any);
    std::size_t missed = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        CHECK(is_usable(rays[i]) == (i >= bad));
        CHECK((hits[i].t < kInfinity) == (any[i] == 1));
        CHECK(scene.closest_hit(rays[i]).has_value() == (any[i] == 1));
        missed += any[i] == 0;
    }
    CHECK(missed == bad);
}

TEST_CASE("Bad geometry: random bits for coordinates are refused or answered alike in both worlds, without NaN",
          "[hard][bad]") {
    Random random(3260);
    const auto bits = [&] {
        return std::bit_cast<double>((std::uint64_t{random.index(std::size_t{1} << 32)} << 32) ^
                                     random.index(std::size_t{1} << 32));
    };
    const auto any_vec = [&] {
        const double x = bits(), y = bits();
        return Vec3{x, y, bits()};
    };
    Tally tally;
    int built = 0;
    for (int i = 0; i < count(1e6); ++i) {
        Object object;
        const Point3 p = Point3{} + any_vec();
        const Vec3 e = any_vec(), f = any_vec();
        const double r = bits();
        Transform m;
        for (auto& row : m.rows)
            for (double& x : row) x = random.chance(0.3) ? bits() : random.uniform(-1, 1);
        try {
            switch (i % 4) {
                case 0: object = ball(p, r); break;
                case 1: object = std::make_shared<Triangle>(p, p + e, p + f, nullptr); break;
                case 2: object = std::make_shared<Quad>(p, e, f, nullptr); break;
                default: object = std::make_shared<Instance>(ball({0, 0, 0}, 1), m); break;
            }
        } catch (const ArgumentError&) {
            continue;
        }
        ++built;
        const BothWorlds worlds(object, {ball({0, 0, 0}, 1)});
        for (int k = 0; k < 4; ++k) {
            Ray ray;
            ray.origin = k % 2 ? Point3{} + any_vec() : Point3{0, 0, 0};
            ray.direction = k < 2 ? any_vec() : p - ray.origin;
            if (k == 3) ray.t_max = bits(), ray.t_min = bits();
            survives(object, worlds, ray, tally);
        }
    }
    check(tally, "random bits");
    CHECK(built > count(1e6) / 4);
}

}  // namespace limn::bad_values_test
