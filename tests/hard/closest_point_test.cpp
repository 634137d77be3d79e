// The nearest points of surfaces, against all triangles in 113 bits.
#include "hard/query_meshes.h"
#include "limn/math/error.h"

namespace limn::closest_point_test {

using namespace test;

namespace {

Real clamped(Real x) { return x < 0 ? Real(0) : x > 1 ? Real(1) : x; }

Real to_segment(const Real3& a, const Real3& b) {
    const Real3 ab = b - a;
    const Real s = dot(ab, ab) > 0 ? clamped(-dot(a, ab) / dot(ab, ab)) : Real(0);
    return length(a + s * ab);
}

// The distance of a triangle from a point: that of its edges, or of the foot on its plane where that is inside.
Real to_triangle(const std::array<Point3, 3>& k, const Point3& p) {
    const Real3 a = Real3(k[0]) - Real3(p), b = Real3(k[1]) - Real3(p), c = Real3(k[2]) - Real3(p);
    Real nearest = to_segment(a, b);
    for (const Real other : {to_segment(b, c), to_segment(c, a)})
        if (other < nearest) nearest = other;
    const Real3 n = cross(b - a, c - a);
    if (dot(n, cross(a, b)) >= 0 && dot(n, cross(b, c)) >= 0 && dot(n, cross(c, a)) >= 0) {
        const Real foot = absolute(dot(a, n)) / length(n);
        if (foot < nearest) nearest = foot;
    }
    return nearest;
}

std::vector<std::array<Point3, 3>> corners_of(const MeshData& data) {
    std::vector<std::array<Point3, 3>> corners;
    for (const Index3& t : data.triangles) corners.push_back({vertex(data, t.a), vertex(data, t.b), vertex(data, t.c)});
    return corners;
}

void judge_nearest(Tally& tally, const CompiledScene& scene, const std::vector<std::array<Point3, 3>>& corners,
                   const Point3& p, double extent) {
    const Ray as_ray{.origin = p, .direction = {1, 0, 0}};
    ++tally.rays, ++tally.judged;
    const auto nearest = scene.closest_point(p);
    if (!nearest) return tally.fault(as_ray, "none");
    Real truth = to_triangle(corners[nearest->element], p);  // no less than the true one
    for (const auto& k : corners) {
        if (length(k[0] - p) - length(k[1] - k[0]) - length(k[2] - k[0]) > 1.001 * static_cast<double>(truth)) continue;
        const Real distance = to_triangle(k, p);
        if (distance < truth) truth = distance;
    }
    const Real allowed = Real(0x1p-32) * Real(std::max(extent, max_abs(p - Point3{})));
    const auto is_off = [&](Real a, Real b) { return !(absolute(a - b) <= allowed); };
    if (is_off(nearest->distance, truth)) tally.fault(as_ray, "distance " + number(nearest->distance, 17));
    if (is_off(to_triangle(corners[nearest->element], p), truth)) tally.fault(as_ray, "another triangle");
    const auto& k = corners[nearest->element];
    const Point3 q = k[0] + nearest->u * (k[1] - k[0]) + nearest->v * (k[2] - k[0]);
    if (is_off(length(q - nearest->position), 0)) tally.fault(as_ray, "u, v");
    if (is_off(length(Real3(nearest->position) - Real3(p)), truth)) tally.fault(as_ray, "position");
    const double w = 1 - nearest->u - nearest->v;
    const int zeros = (nearest->u == 0) + (nearest->v == 0) + (w == 0);
    if (nearest->feature == Feature::vertex && zeros != 2) tally.fault(as_ray, "no vertex");
    if (nearest->feature == Feature::edge && zeros == 0 && std::abs(w) > 1e-15) tally.fault(as_ray, "no edge");
    if (nearest->feature == Feature::face) ++tally.hits;
    if (Real(nearest->distance) > 2000 * allowed && scene.closest_point(p, nearest->distance * 0.999))
        tally.fault(as_ray, "beyond the distance asked for");
    const double distance = scene.signed_distance(p);
    const PointLocation location = scene.locate(p);
    const double signed_truth = location.on_surface ? 0 : location.winding_number != 0 ? -1 : 1;
    if (distance != signed_truth * nearest->distance && !(location.on_surface && distance == 0))
        tally.fault(as_ray, "signed distance");
}

}  // namespace

TEST_CASE("Closest points of meshes: to 2^-32 of the extent, from anywhere, on the surface and beside it",
          "[hard][closest-point]") {
    Random random(621);
    for (const QueryMesh& mesh : query_meshes(random)) {
        const CompiledScene scene = compiled_mesh(mesh.data);
        const auto corners = corners_of(mesh.data);
        double extent = 0;
        for (const auto& k : corners) extent = std::max(extent, max_abs(k[0] - Point3{}));
        Tally tally;
        for (int i = 0; i < count(1e7 / 50); ++i) {
            Point3 p = point_of(random, mesh.data, random.index(3));
            if (i % 5 != 0) p = p + random.log_uniform(1e-12, 1e2) * random.unit();
            judge_nearest(tally, scene, corners, p, extent);
        }
        check(tally, mesh.name);
        CHECK(tally.hits > 0);
    }
}

TEST_CASE("Closest points of slivers: as near as those of any triangle", "[hard][closest-point]") {
    Random random(622);
    Tally tally;
    for (int i = 0; i < count(1e6) / 10; ++i) {
        MeshData data;
        const double width = random.log_uniform(1e-7, 1);
        const Vec3 along = random.unit(), aside = random.unit();
        for (int n = 0; n < 8; ++n) {
            const Point3 a = Point3{} + random.in_cube(1);
            const Vec3 shift = random.uniform(-1, 1) * along;
            for (const Vec3& v : {Vec3{}, along, shift + width * aside})
                data.vertices.push_back(to_float3((a + v) - Point3{}));
            const auto first = static_cast<std::uint32_t>(3 * n);
            data.triangles.push_back({first, first + 1, first + 2});
        }
        const CompiledScene scene = compiled_mesh(data);
        const auto corners = corners_of(data);
        for (int n = 0; n < 10; ++n) {
            Point3 p = point_of(random, data, random.index(3));
            if (n % 2) p = p + random.log_uniform(1e-9, 1) * random.unit();
            judge_nearest(tally, scene, corners, p, 1);
        }
    }
    check(tally, "slivers");
}

TEST_CASE("Closest points: every kind of shape, in instances and media, beside the tree and as it moves",
          "[hard][closest-point]") {
    Scene scene;
    scene.add(ball({0, 0, 0}, 1));
    scene.add(std::make_shared<Quad>(Point3{4, 0, 0}, Vec3{0, 2, 0}, Vec3{0, 0, 2}, nullptr));
    scene.add(std::make_shared<Disk>(Point3{0, 6, 0}, Vec3{0, 3, 0}, 1, nullptr));
    scene.add(std::make_shared<ConstantMedium>(ball({0, 0, 8}, 1), 1, Color{1, 1, 1}));
    scene.add(
        std::make_shared<Instance>(ball({0, 0, 0}, 1), Transform::translate({-10, 0, 0}) * Transform::scale(-2, 2, 2)));
    scene.add(std::make_shared<Sphere>(Point3{0, -20, 0}, Point3{0, -30, 0}, 1, nullptr));
    const auto cube = std::make_shared<Mesh>(cube_mesh(), nullptr);
    const Transform skew = Transform::translate({20, 0, 0}) * Transform::scale(1, 2, 3);
    scene.add(std::make_shared<Instance>(std::make_shared<Instance>(cube, Transform::scale(2, 1, 1)), skew));
    const CompiledScene compiled = compile(scene);
    const auto expect = [&](const Point3& p, std::uint32_t object, double distance, Feature feature, double time = 0) {
        const auto nearest = compiled.closest_point(p, kInfinity, time);
        REQUIRE(nearest);
        CHECK(nearest->object == object);
        CHECK(std::abs(nearest->distance - distance) < 1e-12);
        CHECK(nearest->feature == feature);
        CHECK(std::abs(length(nearest->position - p) - distance) < 1e-12);
        CHECK(nearest->index_matched == (object == 3));
    };
    expect({0, 0.25, 0}, 0, 0.75, Feature::face);
    expect({0, 0, 0}, 0, 1, Feature::face);
    expect({3.5, 1.5, 1.25}, 1, 0.5, Feature::face);
    expect({4, 1, 3}, 1, 1, Feature::edge);
    expect({4, 5, 6}, 1, 5, Feature::vertex);
    expect({0.5, 5.5, 0}, 2, 0.5, Feature::face);
    expect({-3, 6, 0}, 2, 2, Feature::edge);
    expect({0, 0, 11}, 3, 2, Feature::face);
    expect({-15, 0, 0}, 4, 3, Feature::face);
    expect({0, -17, 0}, 5, 2, Feature::face);
    expect({0, -33, 0}, 5, 2, Feature::face, 1);
    expect({23, 0.5, 1.5}, 6, 1, Feature::face);
    expect({21, 2, 4}, 6, 1, Feature::edge);
    expect({23, 4, 5}, 6, 3, Feature::vertex);
    CHECK_FALSE(compiled.closest_point({0, 0, 0}, 0.5));
    CHECK_FALSE(compiled.closest_point({0, kInfinity, 0}));
    CHECK(compiled.signed_distance({0, 0.25, 0}) < 0);
    CHECK(compile(Scene()).signed_distance({0, 0, 0}) == kInfinity);

    Scene odd;
    odd.add(std::make_shared<Instance>(ball({0, 0, 0}, 1), Transform::scale(1, 2, 1)));
    CHECK_THROWS_AS(compile(odd).closest_point({0, 0, 0}), ArgumentError);
    Scene strange;
    strange.add(std::make_shared<Stranger>(ball({0, 0, 0}, 1)));
    CHECK_THROWS_AS(compile(strange).closest_point({0, 0, 0}), ArgumentError);
}

TEST_CASE("Closest points: none farther than asked for, by the distance that is told", "[hard][closest-point]") {
    Scene scene;
    scene.add(ball({0, 0, 0}, 1));
    const CompiledScene compiled = compile(scene);
    CHECK(compiled.closest_point({5, 0, 0}, 4));
    CHECK_FALSE(compiled.closest_point({5, 0, 0}, std::nextafter(4.0, 0.0)));
}

TEST_CASE("Closest points: of spheres in instances of any size", "[hard][closest-point]") {
    for (const double size : {1e-100, 1.0, 1e100, 1e156}) {
        Scene scene;
        scene.add(std::make_shared<Instance>(ball({0, 0, 0}, 1), Transform::scale(size, size, size)));
        const auto nearest = compile(scene).closest_point({3 * size, 0, 0});
        REQUIRE(nearest);
        CHECK(nearest->distance == Approx(2 * size));
    }
}

}  // namespace limn::closest_point_test
