// surface_at(): how far off the true surface the position may be, and which side is which.
#include "catch.h"
#include "limn/math/error.h"
#include "limn/query/compiled_scene.h"
#include "limn/query/normals.h"
#include "support/real.h"
#include "support/scene_zoo.h"
#include "support/tally.h"

namespace limn::surface_test {

using namespace test;

namespace {

// The distance that the error bound admits across a surface with unit normal n. `spare`: what rounding the normal and
// this very sum may cost.
Real admitted(const Surface& s) {
    const Real spare = Real(1) + Real(1e-12);
    return spare * (absolute(Real(s.normal.x)) * s.position_error.x + absolute(Real(s.normal.y)) * s.position_error.y +
                    absolute(Real(s.normal.z)) * s.position_error.z);
}

Real distance_to_plane(const Real3& p, const Real3& a, const Real3& b, const Real3& c) {
    const Real3 n = cross(b - a, c - a);
    return absolute(dot(n, p - a)) / length(n);
}

void check_common(const Ray& ray, const RayHit& hit, const Surface& s, Tally& tally) {
    const double magnitude = length(s.position - Point3{}) + std::abs(hit.t) * length(ray.direction);
    if (!(length(s.position - ray.at(hit.t)) <= 1e-6 * magnitude)) tally.fault(ray, "position is not where the ray is");
    if (!(std::abs(length(Vec3(s.normal)) - 1) <= gamma(8))) tally.fault(ray, "normal is not unit");
    if (!(dot(s.normal, ray.direction) <= 1e-14 * length(ray.direction)))
        tally.fault(ray, "normal is not on the ray's side");
    if (!(dot(s.shading_normal, s.normal) >= 0)) tally.fault(ray, "shading normal is on the other side");
}

}  // namespace

TEST_CASE("surface_at: on a sphere the position is within its error bound of the true surface", "[compile][surface]") {
    Random random(330);
    for (const double scale : {1e-6, 1.0, 1e4, 1e9}) {
        for (const double shift : {0.0, 10.0, 1000.0}) {
            Tally tally;
            for (int i = 0; i < 1000; ++i) {
                const Point3 c = Point3{} + shift * scale * random.unit();
                const double r = random.sign() * scale * random.uniform(0.5, 2);
                const CompiledScene compiled = compile(zoo_of("ball", {ball(c, r)}).scene);
                const Point3 origin = c + random.log_uniform(1.01, 100) * std::abs(r) * random.unit();
                const Point3 o = i % 2 ? origin : c + 0.9 * r * random.unit();  // outside and inside
                const Ray ray{.origin = o, .direction = c + 0.99 * r * random.unit() - o};
                const auto hit = compiled.closest_hit(ray);
                if (!hit) continue;
                ++tally.hits;
                const Surface s = compiled.surface_at(ray, *hit);
                check_common(ray, *hit, s, tally);
                if (absolute(length(Real3(s.position) - Real3(c)) - Real(std::abs(r))) > admitted(s))
                    tally.fault(ray, "position");
                if (s.front_face != ((i % 2 == 1) == (r > 0))) tally.fault(ray, "front_face");
            }
            INFO("scale " << scale << ", shift " << shift << ": " << tally.first);
            CHECK(tally.wrong == 0);
            CHECK(tally.hits > 900);
        }
    }
}

TEST_CASE("surface_at: on triangles and quads the position is within its error bound of the true plane",
          "[compile][surface]") {
    Random random(331);
    for (const double scale : {1e-6, 1.0, 1e4, 1e9}) {
        for (const double shift : {0.0, 10.0, 1000.0}) {
            Tally tally;
            for (int i = 0; i < 1000; ++i) {
                const Point3 a = Point3{} + shift * scale * random.unit();
                const Vec3 e = random.in_cube(scale), f = random.in_cube(scale);
                const bool triangle = i % 2;
                const Object object = triangle ? Object(std::make_shared<Triangle>(a, a + e, a + f, nullptr))
                                               : Object(std::make_shared<Quad>(a, e, f, nullptr));
                const CompiledScene compiled = compile(zoo_of("planar", {object}).scene);
                const double u = random.uniform(0.01, 0.49), v = random.uniform(0.01, 0.49);
                const Point3 aim = a + u * e + v * f;
                const Point3 origin = aim + scale * random.log_uniform(0.1, 100) * random.unit();
                const Ray ray{.origin = origin, .direction = aim - origin};
                const auto hit = compiled.closest_hit(ray);
                if (!hit) continue;
                ++tally.hits;
                const Surface s = compiled.surface_at(ray, *hit);
                check_common(ray, *hit, s, tally);
                const Real3 b = triangle ? Real3(a + e) : Real3(a) + Real3(e),
                            c = triangle ? Real3(a + f) : Real3(a) + Real3(f);
                if (distance_to_plane(Real3(s.position), Real3(a), b, c) > admitted(s)) tally.fault(ray, "position");
                if (s.front_face != (dot(cross(e, f), ray.direction) < 0)) tally.fault(ray, "front_face");
                if (s.uv.u != hit->u || s.uv.v != hit->v) tally.fault(ray, "uv");
            }
            INFO("scale " << scale << ", shift " << shift << ": " << tally.first);
            CHECK(tally.wrong == 0);
            CHECK(tally.hits > 900);
        }
    }
}

TEST_CASE("surface_at: through two instances the position is within its error bound of the true surface",
          "[compile][surface]") {
    Random random(332);
    const Point3 a{0.2, -1, 0.5}, b{1.5, 0.25, -0.5}, c{-1, 1, 0.75};
    const Object triangle = std::make_shared<Triangle>(a, b, c, nullptr);
    for (const double scale : {1e-3, 1.0, 1e3}) {
        for (const double shift : {0.0, 1e3, 1e5}) {
            Tally tally;
            for (int i = 0; i < 500; ++i) {
                const Transform inner = random_pose(random, 2);
                const Transform outer = Transform::translate(shift * random.unit()) *
                                        Transform::rotate(random.unit(), 77) *
                                        Transform::scale(scale, scale, 2 * scale);
                const bool sphere = i % 2;
                const Object object = sphere ? ball({0, 0, 0}, 1) : triangle;
                const CompiledScene compiled = compile(
                    zoo_of("instance", {std::make_shared<Instance>(std::make_shared<Instance>(object, inner), outer)})
                        .scene);
                const auto world = [&](const Real3& p) { return transform_point(outer, transform_point(inner, p)); };
                const Point3 local = sphere ? Point3{} + 0.9 * random.in_cube(0.5)
                                            : a + 0.3 * (b - a) + random.uniform(0.1, 0.5) * (c - a);
                const Real3 exact_aim = world(Real3(local));
                const Point3 aim{static_cast<double>(exact_aim.x), static_cast<double>(exact_aim.y),
                                 static_cast<double>(exact_aim.z)};
                const Point3 origin = aim + 20 * scale * random.unit();
                const Ray ray{.origin = origin, .direction = aim - origin};
                const auto hit = compiled.closest_hit(ray);
                if (!hit) continue;
                ++tally.hits;
                const Surface s = compiled.surface_at(ray, *hit);
                check_common(ray, *hit, s, tally);
                Real off;
                if (sphere) {
                    // Newton's step to |q| = 1 in the sphere's space; the gradient in world space is M^-T q.
                    const Transform m = outer * inner, inv = inverse(m);
                    const Real3 image = transform_point(inv, Real3(s.position));
                    const Real3 residual = Real3(s.position) - world(image);
                    const Real3 q = image + transform_vector(inv, residual);  // one refinement: exact to 1e-28
                    const Normal3 outward(static_cast<double>(q.x), static_cast<double>(q.y), static_cast<double>(q.z));
                    off = absolute(length(q) - Real(1)) / length(Real3(transform_normal(inv, outward)));
                } else {
                    off = distance_to_plane(Real3(s.position), world(Real3(a)), world(Real3(b)), world(Real3(c)));
                }
                if (off > admitted(s)) tally.fault(ray, "position");
            }
            INFO("scale " << scale << ", shift " << shift << ": " << tally.first);
            CHECK(tally.wrong == 0);
            CHECK(tally.hits > 400);
        }
    }
}

TEST_CASE("surface_at: a mesh gives its own normals, texture coordinates and materials", "[compile][surface]") {
    MeshData data;
    data.vertices = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
    data.triangles = {{0, 1, 2}, {0, 2, 3}};
    data.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    data.normals = {{0, 0, 1}, {0.5f, 0, 1}, {0.5f, 0, 1}, {0, 0, 1}};
    data.material_slots = {1, 0};
    const auto red = std::make_shared<Lambertian>(Color{1, 0, 0}), blue = std::make_shared<Lambertian>(Color{0, 0, 1});
    const CompiledScene compiled = compile(
        zoo_of("mesh", {std::make_shared<Mesh>(data, std::vector<std::shared_ptr<const Material>>{red, blue})}).scene);
    const auto at = [&](double x, double y, double side) {
        const Ray ray{.origin = {x, y, side}, .direction = {0, 0, -side}};
        return compiled.surface_at(ray, *compiled.closest_hit(ray));
    };
    for (const double side : {1.0, -1.0}) {
        const Surface lower = at(1.5, 0.5, side), upper = at(0.5, 1.5, side);
        CHECK(lower.uv.u == Approx(0.75));
        CHECK(lower.uv.v == Approx(0.25));
        CHECK(upper.uv.u == Approx(0.25));
        CHECK(upper.uv.v == Approx(0.75));
        CHECK(lower.normal == Normal3{0, 0, side});
        CHECK(lower.front_face == (side > 0));
        CHECK(lower.shading_normal.x * side > 0.1);
        CHECK(lower.material.id != upper.material.id);
        CHECK(lower.material.id != MaterialRef::kNone);
    }
}

// Also as instances, and whatever scales u and v.
TEST_CASE("surface_at: dp_du and dp_dv are how the position moves with the texture coordinates", "[compile][surface]") {
    Random random(77);
    MeshData data = icosphere(1);
    for (std::size_t i = 0; i < data.vertices.size(); ++i) {
        const Vec3 uv = random.in_cube(3);
        data.uvs.push_back({static_cast<float>(uv.x), static_cast<float>(uv.y)});
    }
    const std::vector<Object> shapes = {ball({1, 2, 3}, 2),
                                        ball({0, 0, 1}, -0.5),
                                        std::make_shared<Quad>(Point3{}, Vec3{1, 2, 3}, Vec3{-2, 1, 1}, nullptr),
                                        std::make_shared<Triangle>(Point3{}, Point3{1, 2, 3}, Point3{0, 1, 4}, nullptr),
                                        std::make_shared<Mesh>(data, nullptr),
                                        std::make_shared<Mesh>(icosphere(1), nullptr)};
    for (std::size_t k = 0; k < 2 * shapes.size(); ++k) {
        const Object& shape = shapes[k / 2];
        const Transform pose = random_pose(random);
        const ZooScene zoo = zoo_of("shape", {k % 2 == 0 ? shape : std::make_shared<Instance>(shape, pose)});
        const CompiledScene compiled = compile(zoo.scene);
        int judged = 0;
        for (int i = 0; i < 4000 && judged < 100; ++i) {
            const Ray ray = random_ray(random, zoo.targets);
            const auto hit = compiled.closest_hit(ray);
            if (!hit) continue;
            const Surface s = compiled.surface_at(ray, *hit);
            // A ray beside it, to the same primitive.
            const double reach = 1e-5 * length(zoo.targets.region.diagonal());
            Ray beside = ray;
            beside.origin = s.position + Vec3(s.normal) + reach * random.unit();
            beside.direction = -Vec3(s.normal), beside.t_max = 2, beside.t_min = 0;
            const auto near = compiled.closest_hit(beside);
            if (!near || near->primitive != hit->primitive) continue;
            const Surface n = compiled.surface_at(beside, *near);
            const double du = n.uv.u - s.uv.u, dv = n.uv.v - s.uv.v;
            if (std::abs(du) > 0.1 || std::min(s.uv.v, 1 - s.uv.v) < 0.05) continue;  // seams and poles of balls
            ++judged;
            const Vec3 moved = n.position - s.position;
            CAPTURE(k, s.uv.u, s.uv.v, du, dv);
            CHECK(length(du * s.dp_du + dv * s.dp_dv - moved) < 0.02 * length(moved) + 1e-9);
        }
        CHECK(judged >= 20);
    }
}

TEST_CASE("surface_at: a user's own shape gives its normal, coordinates, material and error as hit() does",
          "[compile][surface]") {
    class Plane final : public Hittable {
    public:
        explicit Plane(std::shared_ptr<const Material> material) : material_(std::move(material)) {}
        Box bounds() const override { return {{-1, -1, 0}, {1, 1, 0}}; }
        std::optional<Hit> hit(const Ray& ray) const override {
            const double t = -ray.origin.z / ray.direction.z;
            if (!is_usable(ray) || !(t > ray.t_min && t <= ray.t_max)) return std::nullopt;
            const Point3 p = ray.at(t);
            if (std::abs(p.x) > 1 || std::abs(p.y) > 1) return std::nullopt;
            return Hit{.t = t,
                       .normal = {0, 0, 1},
                       .u = p.x,
                       .v = p.y,
                       .material = material_.get(),
                       .shading_normal = {0.6, 0, 0.8},
                       .uv = Uv{7, 8},
                       .position_error = {0, 0, 0.125}};
        }

    private:
        std::shared_ptr<const Material> material_;
    };
    const auto grey = std::make_shared<Lambertian>(Color{0.5, 0.5, 0.5});
    const CompiledScene compiled = compile(zoo_of("plane", {std::make_shared<Plane>(grey)}).scene);
    const Ray ray{.origin = {0.25, 0.5, -2}, .direction = {0, 0, 1}};
    const auto hit = compiled.closest_hit(ray);
    REQUIRE(hit);
    CHECK((hit->t == 2 && hit->u == 0.25 && hit->v == 0.5));
    const Surface s = compiled.surface_at(ray, *hit);
    CHECK((s.uv.u == 7 && s.uv.v == 8));
    CHECK(s.normal == Normal3{0, 0, -1});
    CHECK_FALSE(s.front_face);
    CHECK(length(Vec3(s.shading_normal) - Vec3{-0.6, 0, -0.8}) <= 1e-15);
    CHECK(s.material.object == grey.get());
    CHECK(s.position_error.z >= 0.125);
    CHECK(s.position_error.x > 0);  // at least the rounding of ray.at(t)
    CHECK(s.position_error.x < 1e-12);
}

TEST_CASE("outward_normals: those of surface_at, from whichever side a ray came, zero for a miss",
          "[compile][surface]") {
    int hits = 0, misses = 0, inside = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        Random random(seed);
        std::vector<Object> objects;
        for (int i = 0; i < 10; ++i) objects.push_back(random_object(random, 2));
        const ZooScene zoo = zoo_of("zoo", objects);
        const CompiledScene compiled = compile(zoo.scene);
        std::vector<Ray> rays;
        for (int i = 0; i < 1000; ++i) rays.push_back(random_ray(random, zoo.targets));
        std::vector<RayHit> found(rays.size());
        compiled.closest_hit(rays, found);
        std::vector<Vec3> normals(rays.size(), Vec3{1, 2, 3});
        outward_normals(compiled, rays, found, normals);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (found[i].t == kInfinity) {
                ++misses;
                CHECK(normals[i] == Vec3{});
                continue;
            }
            const Surface s = compiled.surface_at(rays[i], found[i]);
            ++hits, inside += s.front_face ? 0 : 1;
            CHECK(normals[i] == (s.front_face ? 1.0 : -1.0) * Vec3(s.normal));
        }
    }
    CHECK((hits > 1000 && misses > 1000 && inside > 100));
    const CompiledScene empty = compile(Scene{});
    const std::vector<Ray> two(2);
    const std::vector<RayHit> one(1);
    std::vector<Vec3> normals(2);
    CHECK_THROWS_AS(outward_normals(empty, two, one, normals), ArgumentError);
}

}  // namespace limn::surface_test
