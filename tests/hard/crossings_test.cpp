// Passages through closed surfaces and winding numbers, against those of points a little beside.
#include "hard/query_meshes.h"
#include "limn/math/error.h"

namespace limn::crossings_test {

using namespace test;

namespace {

// The winding number of a point by solid angles (van Oosterom, Strackee, 1983), in 113 bits.
class ExactWinding {
public:
    explicit ExactWinding(const MeshData& data) : data_(data) {}

    // None on the surface, or so near that rounding might show.
    std::optional<std::int64_t> at(const Point3& p) const {
        double sum = 0;
        for (const Index3& t : data_.triangles) {
            const Real3 a = seen(t.a, p), b = seen(t.b, p), c = seen(t.c, p);
            const Real la = length(a), lb = length(b), lc = length(c);
            const Real det = dot(a, cross(b, c));
            const Real over = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
            if (absolute(det) < Real(1e-25) * la * lb * lc && over < Real(1e-6) * la * lb * lc) return std::nullopt;
            sum += 2 * std::atan2(static_cast<double>(det), static_cast<double>(over));
        }
        const double turns = sum / (4 * kPi);
        if (!(std::abs(turns - std::round(turns)) < 1e-6)) return std::nullopt;
        return static_cast<std::int64_t>(std::round(turns));
    }

private:
    Real3 seen(std::uint32_t i, const Point3& p) const { return Real3(vertex(data_, i)) - Real3(p); }
    const MeshData& data_;
};

// That of the point moved as the rule says.
std::int64_t moved_winding(const MeshData& data, const Point3& p) {
    const Vec3 direction{0.362718281828, 0.594235253645, 0.718281828459};
    std::int64_t outward = 0;
    for (const Index3& t : data.triangles)
        outward += exact_moved_passage(vertex(data, t.a), vertex(data, t.b), vertex(data, t.c), p, direction);
    return outward;
}

double size_of(const MeshData& data) {
    double size = 0;
    for (std::uint32_t i = 0; i < data.vertices.size(); ++i) size = std::max(size, max_abs(vertex(data, i) - Point3{}));
    return size;
}

bool is_on(const MeshData& data, const Point3& p) {
    for (const Index3& t : data.triangles)
        if (exactly_on_triangle(vertex(data, t.a), vertex(data, t.b), vertex(data, t.c), p)) return true;
    return false;
}

// A point of the surface, or one or some ulps beside it, or anywhere.
Point3 query_point(Random& random, const MeshData& data) {
    Point3 p = point_of(random, data, random.index(3));
    const std::size_t kind = random.index(4);
    if (kind == 0) return p;
    if (kind == 1) {
        for (std::size_t a = 0; a < 3; ++a)
            if (random.chance(0.5)) p[a] = std::nextafter(p[a], random.sign() * 1e300);
        return p;
    }
    return p + random.log_uniform(1e-15, 2) * size_of(data) * random.unit();
}

}  // namespace

TEST_CASE("Crossings: between two points a ray passes through a closed mesh as often as their winding numbers say",
          "[hard][crossings]") {
    Random random(611);
    for (const QueryMesh& mesh : query_meshes(random)) {
        const CompiledScene scene = compiled_mesh(mesh.data);
        CHECK(scene.open_edges() == 0);
        Tally tally;
        for (int i = 0; i < count(1e7 / 10); ++i) {
            Ray ray = query_ray(random, mesh.data);
            ++tally.rays, ++tally.judged;
            const std::vector<RayCrossing> crossings = scene.crossings(ray);
            if (crossings.size() != scene.count_intersections(ray)) tally.fault(ray, "another count");
            std::int64_t outward = 0;
            for (const RayCrossing& c : crossings) outward += c.inward ? -1 : 1;
            if (outward != scene.winding_number(ray)) tally.fault(ray, "another sum");
            if (!std::is_sorted(crossings.begin(), crossings.end(),
                                [](const RayCrossing& a, const RayCrossing& b) { return a.t < b.t; }))
                tally.fault(ray, "not sorted");
            tally.hits += crossings.size();
            // Every line goes in as often as out.
            Ray line = ray;
            line.t_min = -kInfinity, line.t_max = kInfinity;
            if (scene.winding_number(line) != 0 || scene.count_intersections(line) % 2 != 0)
                tally.fault(line, "a line does not leave what it enters");
            // From the origin, any way: the same.
            Ray ahead = ray;
            ahead.t_min = 0, ahead.t_max = kInfinity;
            const std::int64_t there = scene.winding_number(ahead);
            const Ray other{.origin = ray.origin, .direction = random.chance(0.5) ? random.unit() : -ray.direction};
            if (scene.winding_number(other) != there || scene.locate(ray.origin).winding_number != there)
                tally.fault(ray, "another direction gives another winding number");
            // Pieces add up, wherever they are cut.
            Ray first = ahead, second = ahead;
            first.t_max = second.t_min = crossings.empty() ? 1 : std::max(0.0, crossings.front().t);
            if (scene.count_intersections(first) + scene.count_intersections(second) !=
                scene.count_intersections(ahead))
                tally.fault(ray, "pieces do not add up");
        }
        check(tally, mesh.name);
        CHECK(tally.hits > tally.rays / 4);
    }
}

TEST_CASE("Winding numbers: of points anywhere, on the surface and one ulp beside it, as exact arithmetic has them",
          "[hard][crossings]") {
    Random random(612);
    for (const QueryMesh& mesh : query_meshes(random)) {
        const CompiledScene scene = compiled_mesh(mesh.data);
        const ExactWinding solid_angle(mesh.data);
        Tally tally;
        for (int i = 0; i < count(1e7 / 100); ++i) {
            const Point3 p = query_point(random, mesh.data);
            const Ray as_ray{.origin = p, .direction = {1, 0, 0}};
            ++tally.rays, ++tally.judged;
            const PointLocation location = scene.locate(p);
            const bool is_on_surface = is_on(mesh.data, p);
            if (location.on_surface != is_on_surface) tally.fault(as_ray, is_on_surface ? "not on it" : "on it");
            if (location.winding_number != moved_winding(mesh.data, p))
                tally.fault(as_ray, "not that of the moved point");
            if (scene.contains(p) != (is_on_surface || location.winding_number != 0)) tally.fault(as_ray, "contains");
            if (i % 16 == 0) {  // the dearest of the three
                const auto truth = solid_angle.at(p);
                if (truth && !is_on_surface && location.winding_number != *truth) tally.fault(as_ray, "solid angle");
            }
            if (location.on_surface) {
                ++tally.hits;
                const Index3 t = mesh.data.triangles[location.primitive];
                if (!exactly_on_triangle(vertex(mesh.data, t.a), vertex(mesh.data, t.b), vertex(mesh.data, t.c), p))
                    tally.fault(as_ray, "on another primitive");
            }
        }
        check(tally, mesh.name);
        CHECK(tally.hits > tally.rays / 20);
    }
}

TEST_CASE("Crossings: through vertices, along edges and in the planes of faces of a cube", "[hard][crossings]") {
    const CompiledScene cube = compiled_mesh(cube_mesh());
    Scene scene;
    scene.add(make_box({0, 0, 0}, {1, 1, 1}, nullptr));
    const CompiledScene box = compile(scene);
    CHECK(box.open_edges() == 0);
    for (const CompiledScene* c : {&cube, &box}) {
        CHECK(c->count_intersections(towards({-1, -1, -1}, {1, 1, 1})) == 2);    // from corner to corner
        CHECK(c->count_intersections(towards({0.5, 0.5, -1}, {0, 0, 1})) == 2);  // through a face's diagonal
        CHECK(c->count_intersections(towards({-1, 0, 0.5}, {1, 1, 0})) % 2 == 0);
        for (const double x : {0.0, 0.5, 1.0})
            for (const double y : {0.0, 0.5, 1.0}) {  // within faces and along edges: moved in, or out
                CHECK(c->count_intersections(towards({x, y, -1}, {0, 0, 1})) == (x < 1 && y < 1 ? 2u : 0u));
                CHECK(c->winding_number(towards({x, y, 0.5}, {0, 0, 1})) == (x < 1 && y < 1 ? 1 : 0));
                for (const double z : {0.0, 0.5, 1.0}) {
                    const PointLocation location = c->locate({x, y, z});
                    CHECK(location.winding_number == (x < 1 && y < 1 && z < 1 ? 1 : 0));
                    CHECK(location.on_surface == (x != 0.5 || y != 0.5 || z != 0.5));
                    CHECK(c->contains({x, y, z}));
                }
            }
        CHECK_FALSE(c->contains({1 + 0x1p-52, 0.5, 0.5}));
        CHECK_FALSE(c->contains({0.5, -5e-324, 0.5}));
        CHECK(c->contains({1 - 0x1p-53, 5e-324, 0.5}));
    }
}

TEST_CASE("Crossings: spheres, instances that mirror and turn, media and nested shells", "[hard][crossings]") {
    Random random(613);
    Scene scene;
    scene.add(ball({0, 0, 0}, 2));
    scene.add(ball({0, 0, 0}, -1));
    scene.add(std::make_shared<ConstantMedium>(ball({10, 0, 0}, 1), 1, Color{1, 1, 1}));
    const auto mesh = std::make_shared<Mesh>(cube_mesh(), nullptr);
    std::vector<Transform> poses;
    for (int i = 0; i < 20; ++i) {
        poses.push_back(random_pose(random, 4));
        scene.add(std::make_shared<Instance>(mesh, poses.back()));
    }
    const CompiledScene compiled = compile(scene);
    CHECK(compiled.open_edges() == 0);
    Tally tally;
    for (int i = 0; i < count(1e6); ++i) {
        const Transform& m = poses[random.index(poses.size())];
        Point3 p = transform_point(m, point_of(random, cube_mesh(), random.index(3)));
        if (random.chance(0.5)) p = p + random.log_uniform(1e-16, 1) * random.unit();
        if (random.chance(0.1)) p = Point3{} + random.unit();
        const Ray ray{.origin = p, .direction = random.chance(0.5) ? random.unit() : Vec3{0, 0, random.sign()}};
        const Ray back{.origin = p, .direction = -random.uniform(0.1, 3) * ray.direction};
        ++tally.rays, ++tally.judged;
        const std::int64_t ahead = compiled.winding_number(ray);
        if (compiled.winding_number(back) != ahead) tally.fault(ray, "ahead is not behind");
        if (compiled.locate(p).winding_number != ahead) tally.fault(ray, "located elsewhere");
        tally.hits += compiled.count_intersections(ray);
    }
    check(tally, "mixed");
    CHECK(compiled.locate({1.5, 0, 0}).winding_number >= 1);
    Scene shells;
    shells.add(ball({0, 0, 0}, 2));
    shells.add(ball({0, 0, 0}, -1));
    shells.add(std::make_shared<ConstantMedium>(ball({10, 0, 0}, 1), 1, Color{1, 1, 1}));
    const CompiledScene hollow = compile(shells);
    CHECK(hollow.locate({0, 0, 0}).winding_number == 0);
    CHECK(hollow.locate({1.5, 0, 0}).winding_number == 1);
    CHECK(hollow.locate({10, 0, 0}).winding_number == 1);
    CHECK((hollow.locate({1, 0, 0}).on_surface && hollow.locate({1, 0, 0}).primitive == 1));
    const auto through = hollow.crossings(towards({-5, 0, 0}, {1, 0, 0}));
    REQUIRE(through.size() == 6);
    for (std::size_t i = 0; i < 6; ++i) {
        CHECK(through[i].inward == (i == 0 || i == 2 || i == 4));
        CHECK(through[i].index_matched == (i > 3));
    }
    CHECK(hollow.count_intersections(towards({-5, 2, 0}, {1, 0, 0})) % 2 == 0);  // touches
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(hollow.contains({nan, 0, 0}));
    CHECK_FALSE(hollow.contains({kInfinity, 0, 0}));
    for (const Ray& ray : unusable_rays()) CHECK(hollow.count_intersections(ray) == 0);
}

TEST_CASE("Open edges: none of closed meshes, welded or not, and those of a hole, of a lone triangle and of a disk",
          "[hard][crossings]") {
    MeshData soup;
    const MeshData closed = icosphere(2);
    for (const Index3& t : closed.triangles)
        for (const std::uint32_t i : {t.a, t.b, t.c}) {
            if (soup.vertices.size() % 3 == 0) {
                const auto n = static_cast<std::uint32_t>(soup.vertices.size());
                soup.triangles.push_back({n, n + 1, n + 2});
            }
            soup.vertices.push_back(closed.vertices[i]);
        }
    CHECK(compiled_mesh(soup).open_edges() == 0);
    soup.triangles.pop_back();
    CHECK(compiled_mesh(soup).open_edges() == 3);
    std::swap(soup.triangles[0].b, soup.triangles[0].c);  // turned round: its edges count twice
    CHECK(compiled_mesh(soup).open_edges() > 3);
    Scene scene;
    scene.add(std::make_shared<Disk>(Point3{0, 0, 0}, Vec3{0, 0, 1}, 1, nullptr));
    const Object lone = std::make_shared<Triangle>(Point3{0, 0, 0}, Point3{1, 0, 0}, Point3{0, 1, 0}, nullptr);
    scene.add(std::make_shared<Instance>(lone, Transform::translate({5, 0, 0})));
    scene.add(std::make_shared<Instance>(lone, Transform::translate({7, 0, 0})));
    CHECK(compile(scene).open_edges() == 7);
}

TEST_CASE("Crossings: where a ray touches a box or runs along its face it enters and leaves, or misses",
          "[hard][crossings]") {
    Scene scene;
    scene.add(make_box({0, 0, 0}, {1, 1, 1}, nullptr));
    const CompiledScene box = compile(scene);
    const auto count = [&](const Point3& origin, const Vec3& way) { return box.count_intersections({origin, way}); };
    CHECK(count({-1, 1, 0.5}, {1, -1, 0}) == 2);  // at an edge
    CHECK(count({-1, 0, 0.5}, {1, 0, 0}) == 2);   // along a face
    CHECK(count({-1, 1, 0.5}, {1, 0, 0}) == 0);   // along the opposite one
    scene.add(ball({9, 0, 0}, 1));
    CHECK(compile(scene).count_intersections({{9, 1, 5}, {0, 0, -1}}) == 0);
}

}  // namespace limn::crossings_test
