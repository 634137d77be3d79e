// Meshes: nothing escapes through vertices and edges, flat triangles among good ones, float32 from end to end.
#include "hard/exact_mesh.h"
#include "limn/math/error.h"

namespace limn::mesh_test {

using namespace test;

namespace {

std::shared_ptr<const Mesh> mesh_of(const MeshData& data) { return std::make_shared<Mesh>(data, nullptr); }

MeshData snapped(MeshData mesh, float steps) {
    for (Float3& p : mesh.vertices)
        p = {std::round(p.x * steps) / steps, std::round(p.y * steps) / steps, std::round(p.z * steps) / steps};
    return mesh;
}

// From inside, at a vertex or at a point of an edge.
Ray aimed(Random& random, const MeshData& mesh, const Point3& center, double radius, bool at_vertex, bool in_float) {
    const Index3 t = mesh.triangles[random.index(mesh.triangles.size())];
    const Point3 a = vertex(mesh, t.a), b = vertex(mesh, t.b);
    Point3 origin = center + random.uniform(0, 0.4) * radius * random.unit();
    if (in_float) origin = to_float(origin);
    const Vec3 d = a + (at_vertex ? 0 : random.uniform()) * (b - a) - origin;
    return towards(origin, in_float ? to_float(d) : d);
}

std::optional<Answer> answer_of(const std::optional<RayHit>& hit) {
    if (!hit) return std::nullopt;
    return Answer{hit->t, hit->u, hit->v, hit->element};
}

struct Inside {
    MeshData data;
    Point3 center;
    double radius;
    std::vector<Transform> chain = {};  // of instances, outermost first
};

// The compiled scene is asked for all rays, exact arithmetic about one in 8 of its answers, and for a mesh without
// instances one in 4000 goes to every triangle, in both worlds and in exact arithmetic.
Tally escapes(const Inside& inside, int rays, std::uint64_t seed) {
    Random random(seed);
    const auto& [data, center, radius, chain] = inside;
    const ExactMesh exact(data);
    const BothWorlds world(mesh_of(data), company_near(random, center, radius));
    Object object = mesh_of(data);
    for (auto m = chain.rbegin(); m != chain.rend(); ++m) object = std::make_shared<Instance>(object, *m);
    Scene scene;
    scene.add(object);
    scene.add(ball(object->bounds().center(), 3 * length(object->bounds().diagonal())));  // what escapes ends here
    const CompiledScene compiled = compile(scene);
    Tally tally;
    for (int i = 0; i < rays; ++i) {
        Ray ray = aimed(random, data, center, radius, i % 2 == 0, i % 24 < 12);
        if (i % 4000 == 0 && chain.empty())
            judge_mesh(tally, world, exact, ray);
        else
            ++tally.rays, ++tally.judged;
        for (auto m = chain.rbegin(); m != chain.rend(); ++m)
            ray = towards(transform_point(*m, ray.origin), transform_vector(*m, ray.direction));
        const auto hit = compiled.closest_hit(ray);
        if (!hit || hit->object != 0) tally.fault(ray, "escaped");
        if (i % 8 >= 2 || !hit || hit->object != 0) continue;
        if (!compiled.any_hit(ray)) tally.fault(ray, "any_hit");
        const ExactHit truth = exact.hit_of(hit->element, ray, chain);
        const std::string fault = detail::fault_of(truth, answer_of(hit), {});
        if (!fault.empty()) tally.fault(ray, fault);
    }
    return tally;
}

}  // namespace

TEST_CASE("Closed meshes: no ray from inside escapes through a vertex or an edge, at any distance from the origin",
          "[hard][mesh]") {
    Random random(550);
    for (const double shift : {0.0, 1e3, 1e5, 1e7}) {
        const double radius = shift < 1e6 ? 1 : 100;  // float32 has steps of 1 at 1e7
        const Point3 center = to_float(Point3{shift, -shift, shift});
        const std::pair<const char*, MeshData> meshes[] = {
            {"icosphere", icosphere(5, radius, center - Point3{})},
            {"snapped", snapped(icosphere(4, radius, center - Point3{}), 4096)},
            {"bumpy", bumpy_sphere(random, 7, 0.03, radius, center)},
            {"needles", bumpy_sphere(random, 5, 0.3, radius, center)}};
        for (const auto& [name, mesh] : meshes)
            check(escapes({mesh, center, radius}, count(1e8 / 16), 551), name + (" at " + number(shift)));
        check(escapes({double_cone(100, radius, center), center, radius}, count(1e5), 559), "fans of 100");
    }
}

TEST_CASE("Closed meshes: no ray from inside escapes from one seen through instances", "[hard][mesh]") {
    const Transform small =
        Transform::translate({1e3, -5, 7}) * Transform::rotate({1, 2, 3}, 40) * Transform::scale(0.01, 0.02, 0.03);
    const Transform mirrored = Transform::rotate({3, -1, 2}, 77) * Transform::scale(-1e3, 1, 5);
    const MeshData mesh = icosphere(3);
    check(escapes({mesh, {}, 1, {small}}, count(2e6), 557), "one instance");
    check(escapes({mesh, {}, 1, {small, mirrored}}, count(2e6), 558), "two instances");
}

TEST_CASE("Closed meshes: no ray escapes from one of single triangles in double", "[hard][mesh]") {
    Random random(560);
    for (const double shift : {0.0, 0.1, 1e3, 1e7, 1e12}) {
        const MeshData shape = bumpy_sphere(random, 4, 0.3, 1, {0, 0, 0});
        std::vector<Point3> points;
        for (std::uint32_t i = 0; i < shape.vertices.size(); ++i)
            points.push_back(vertex(shape, i) + Vec3{shift, shift / 3, -shift} + 1e-9 * random.in_cube());
        const auto corners = [&](std::size_t i) {
            const Index3 t = shape.triangles[i];
            return std::array<Point3, 3>{points[t.a], points[t.b], points[t.c]};
        };
        std::vector<Object> triangles;
        for (std::size_t i = 0; i < shape.triangles.size(); ++i) {
            const auto [a, b, c] = corners(i);
            triangles.push_back(std::make_shared<Triangle>(a, b, c, nullptr));
        }
        const BothWorlds world(std::make_shared<Bvh>(triangles));
        Tally tally;
        for (int i = 0; i < count(2e5); ++i) {
            const auto [a, b, c] = corners(random.index(triangles.size()));
            const Point3 origin = Point3{shift, shift / 3, -shift} + 0.3 * random.unit();
            const Ray ray = towards(origin, (i % 2 ? a : a + random.uniform() * (b - a)) - origin);
            ++tally.rays, ++tally.judged;
            const auto hit = world.hit(ray, tally);
            if (!hit) {
                tally.fault(ray, "escaped");
                continue;
            }
            const auto [p, q, r] = corners(hit->element);
            const std::string fault = detail::fault_of(exact_triangle_hit(p, q, r, ray), hit, {});
            if (!fault.empty()) tally.fault(ray, fault);
        }
        check(tally, "at " + number(shift));
    }
}

TEST_CASE("Closed meshes: rays 1e-7 to 1e-16 beside vertices and edges are decided exactly, in both worlds",
          "[hard][mesh]") {
    Random random(552);
    for (const double shift : {0.0, 1e3, 1e5}) {
        const Point3 center = to_float(Point3{shift, shift, -shift});
        for (const MeshData& data : {icosphere(2, 1, center - Point3{}), bumpy_sphere(random, 3, 0.5, 1, center)}) {
            const BothWorlds world(mesh_of(data), company_near(random, center, 1));
            const ExactMesh exact(data);
            Tally tally;
            for (int i = 0; i < count(1e5); ++i) {
                Ray ray = aimed(random, data, center, 1, i % 2 == 0, false);
                if (i % 4 < 2) ray.origin = center + 5 * random.unit();
                const Point3 aim = ray.origin + ray.direction + random.log_uniform(1e-16, 1e-7) * random.unit();
                ray.direction = aim - ray.origin;
                judge_mesh(tally, world, exact, ray);
            }
            check(tally, "at " + number(shift));
        }
    }
}

TEST_CASE("Strips of slivers: no ray passes between two that share an edge", "[hard][mesh]") {
    Random random(553);
    for (double aspect = 1e2; aspect < 2e6; aspect *= 10) {
        for (const double shift : {0.0, 1e3}) {
            // Nearly flat, seen from above or below: nothing but inner edges within reach of a ray. Across the strip
            // coordinates stay near 0, where float32 has room for its steps of 1 / aspect.
            MeshData data;
            for (int i = 0; i < 66; ++i)
                data.vertices.push_back(to_float3({shift + (i % 2), i / aspect, random.uniform(0, 0.05) / aspect}));
            for (std::uint32_t i = 0; i < 64; ++i) data.triangles.push_back({i, i + 1, i + 2});
            const BothWorlds world(mesh_of(data));
            Scene scene;
            scene.add(mesh_of(data));
            const CompiledScene compiled = compile(scene);
            const ExactMesh exact(data);
            Tally tally;
            for (int i = 0; i < count(1e7 / 10); ++i) {
                const std::uint32_t e =
                    1 + static_cast<std::uint32_t>(random.index(63));  // from vertex e to e + 1: inner
                const Point3 a = vertex(data, e), b = vertex(data, e + 1);
                const Point3 aim = a + random.uniform(0.01, 0.99) * (b - a);
                const Vec3 away = random.in_cube() + Vec3{0, 0, random.sign() * 1.5};
                const Ray ray = towards(aim + random.uniform(0.5, 10) * away, -away);
                if (i % 50 == 0)
                    judge_mesh(tally, world, exact, ray);
                else
                    ++tally.rays, ++tally.judged;
                const auto hit = compiled.closest_hit(ray);
                if (!hit) tally.fault(ray, "between");
                const ExactHit truth = exact.hit_of(hit ? hit->element : e, ray);
                const std::string fault = detail::fault_of(truth, answer_of(hit), {});
                if (!fault.empty()) tally.fault(ray, fault);
            }
            check(tally, "aspect " + number(aspect) + " at " + number(shift));
        }
    }
}

TEST_CASE("Cubes: along edges, from corner to corner, in a face's plane: t is 1 in all symmetric copies",
          "[hard][mesh]") {
    const BothWorlds triangles(mesh_of(cube_mesh())), quads(make_box({0, 0, 0}, {1, 1, 1}, nullptr));
    const Ray rays[] = {towards({-1, 0, 0}, {1, 0, 0}), towards({-1, -1, -1}, {1, 1, 1}),
                        towards({-1, 0.5, 0}, {1, 0, 0}), towards({-1, -1, 0}, {1, 1, 0})};
    const std::size_t permutations[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    const ExactMesh exact(cube_mesh());
    Tally tally;
    for (const Ray& ray : rays) {
        for (const auto& p : permutations) {
            for (int mirror = 0; mirror < 8; ++mirror) {
                Ray copy;
                for (std::size_t a = 0; a < 3; ++a) {
                    const bool turn = (mirror >> a) & 1;
                    copy.origin[p[a]] = turn ? 1 - ray.origin[a] : ray.origin[a];
                    copy.direction[p[a]] = turn ? -ray.direction[a] : ray.direction[a];  // 0 becomes -0
                }
                judge_mesh(tally, triangles, exact, copy);
                for (const BothWorlds* world : {&triangles, &quads}) {
                    const auto hit = world->hit(copy, tally);
                    if (!hit || hit->t != 1) tally.fault(copy, "t is not 1");
                }
            }
        }
    }
    check(tally, "copies");
    CHECK(tally.rays == 192);
}

TEST_CASE("Meshes: u, v point at where the ray is, to 4 float ulps of the largest coordinate", "[hard][mesh]") {
    Random random(554);
    for (const double shift : {0.0, 1e3, 1e5}) {
        const Point3 center{shift, shift, 0};
        const MeshData data = icosphere(5, 1, center - Point3{});
        Scene scene;
        scene.add(mesh_of(data));
        const CompiledScene compiled = compile(scene);
        Tally tally;
        for (int i = 0; i < count(1e6); ++i) {
            const Point3 origin = center + random.uniform(1, 20) * random.unit();
            const Ray ray = towards(origin, center + 0.9 * random.unit() - origin);
            ++tally.rays, ++tally.judged;
            const auto hit = compiled.closest_hit(ray);
            if (!hit) {
                tally.fault(ray, "missed");
                continue;
            }
            const Index3 t = data.triangles[hit->element];
            const Point3 a = vertex(data, t.a), b = vertex(data, t.b), c = vertex(data, t.c);
            const Point3 p = a + hit->u * (b - a) + hit->v * (c - a);
            const double largest = max_abs(p - Point3{});
            if (hit->u < 0 || hit->v < 0 || hit->u + hit->v > 1) tally.fault(ray, "outside");
            if (length(p - ray.at(hit->t)) > 4 * 0x1p-23 * largest) tally.fault(ray, "another point");
        }
        check(tally, "at " + number(shift));
    }
}

TEST_CASE("Meshes: triangles of exactly no area are dropped and counted, their neighbours stay", "[hard][mesh]") {
    Random random(555);
    Tally tally;
    std::size_t flat = 0, all = 0;
    for (int i = 0; i < count(1e5); ++i) {
        MeshData data;
        const auto number_of_21_bits = [&] {
            return static_cast<double>(random.index(1 << 21)) * std::ldexp(1.0, static_cast<int>(random.index(60)));
        };
        for (int n = 0; n < 6; ++n) data.vertices.push_back(to_float3(number_of_21_bits() * Vec3{3, 5, 7}));  // in line
        for (int n = 0; n < 3; ++n) {  // one float beside the line
            data.vertices.push_back(data.vertices[random.index(6)]);
            data.vertices.back().y = std::nextafter(data.vertices.back().y, random.chance(0.5) ? 1e30F : -1e30F);
        }
        for (int n = 0; n < 3; ++n) data.vertices.push_back(to_float3(random.in_cube(1e18)));
        for (int n = 0; n < 12; ++n) {
            const auto any = [&] { return static_cast<std::uint32_t>(random.index(data.vertices.size())); };
            data.triangles.push_back({any(), any(), any()});
        }
        data.triangles.push_back({9, 10, 11});
        const ExactMesh exact(data);
        const auto mesh = mesh_of(data);
        const BothWorlds world(mesh);
        ++tally.rays, ++tally.judged;
        if (mesh->degenerate_triangles() != exact.flat_triangles()) tally.fault({}, "another count");
        flat += exact.flat_triangles(), all += data.triangles.size();
        for (int n = 0; n < 10; ++n) {
            const Index3 t = data.triangles[random.index(data.triangles.size())];
            const Point3 a = vertex(data, t.a), b = vertex(data, t.b), c = vertex(data, t.c);
            const Point3 aim = a + random.uniform(0, 0.5) * (b - a) + random.uniform(0, 0.5) * (c - a);
            const Point3 eye = Point3{} + random.in_cube(1e19);
            judge_mesh(tally, world, exact, towards(eye, aim - eye));
        }
    }
    check(tally, "flat ones");
    CHECK((flat > all / 10 && flat < all * 9 / 10));
}

TEST_CASE("Meshes: equal vertices, points in line and one point thrice are no area, NaN and infinity are refused",
          "[hard][mesh]") {
    MeshData data;
    data.vertices = {{0, 0, 0},
                     {1, 1, 1},
                     {2, 2, 2},
                     {1, 0, 0},
                     {0, 1, 0},
                     {-1113.45459F, -79.049614F, -56.2431908F},  // pbrt's bad case: in line whatever its y
                     {-1113.45459F, -87.0922699F, -56.2431908F},
                     {-1113.45459F, -79.2090149F, -56.2431908F}};
    data.triangles = {{0, 1, 2}, {0, 0, 3}, {0, 0, 0}, {3, 0, 3}, {5, 6, 7}, {0, 3, 4}};
    const auto mesh = mesh_of(data);
    CHECK(mesh->degenerate_triangles() == 5);
    const BothWorlds world(mesh);
    Tally tally;
    const auto hit = world.hit(towards({0.25, 0.25, 1}, {0, 0, -1}), tally);
    REQUIRE(hit);
    CHECK((hit->t == 1 && hit->element == 5));
    judge_mesh(tally, world, ExactMesh(data),
               towards({-1081.47925, 99.9999542, 87.7701111}, {-32.1072998, -183.355865, -144.607635}));
    CHECK(tally.hits == 0);
    CHECK(tally.wrong == 0);
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        MeshData spoilt = data;
        spoilt.vertices[4].y = bad;
        CHECK_THROWS_AS(mesh_of(spoilt), ArgumentError);
    }
}

TEST_CASE("Meshes: from float32's least subnormals to its largest numbers, in one mesh too, all is decided exactly",
          "[hard][mesh]") {
    Random random(556);
    Tally tally;
    for (int i = 0; i < count(1e5); ++i) {
        const int least = i % 3 == 0 ? -149 : i % 3 == 1 ? -120 : 90, span = i % 3 == 0 ? 8 : i % 3 == 1 ? 230 : 36;
        const auto wild = [&] {
            return random.sign() * std::ldexp(random.uniform(1, 2),
                                              least + static_cast<int>(random.index(static_cast<std::size_t>(span))));
        };
        MeshData data;
        for (int n = 0; n < 6; ++n) data.vertices.push_back(to_float3({wild(), wild(), wild()}));
        data.triangles = {{0, 1, 2}, {2, 1, 3}, {3, 4, 5}, {0, 2, 5}, {1, 1, 2}};
        const ExactMesh exact(data);
        const auto mesh = mesh_of(data);
        ++tally.rays, ++tally.judged;
        if (mesh->degenerate_triangles() != exact.flat_triangles()) tally.fault({}, "another count");
        const BothWorlds world(mesh);
        for (int n = 0; n < 10; ++n) {
            const Index3 t = data.triangles[random.index(4)];
            const Point3 a = vertex(data, t.a), b = vertex(data, t.b), c = vertex(data, t.c);
            const Point3 aim = n % 2 ? a + random.uniform(0, 0.5) * (b - a) + random.uniform(0, 0.5) * (c - a) : a;
            const Point3 eye{wild(), wild(), wild()};
            judge_mesh(tally, world, exact, towards(eye, random.chance(0.5) ? aim - eye : 1e-30 * (aim - eye)));
        }
    }
    check(tally, "float32");
    CHECK(tally.hits > tally.rays / 4);
}

TEST_CASE("Meshes: triangles of size 1e-20 to 1e18 are hit at the exact t, from any distance", "[hard][mesh]") {
    Tally tally;
    for (int k = -20; k <= 18; ++k) {
        const auto s = static_cast<float>(std::pow(10.0, k));
        MeshData data;
        data.vertices = {{0, 0, 0}, {s, 0, 0}, {0, s, 0}};
        data.triangles = {{0, 1, 2}};
        const BothWorlds world(mesh_of(data));
        const double x = static_cast<double>(s) / 3;
        for (const double z : {10.0 * static_cast<double>(s), 1.0, 1e5, 1e-5}) {
            const auto hit = world.hit(towards({x, x, -z}, {0, 0, 1}), tally);
            if (!hit || std::abs(hit->t / z - 1) > 0x1p-23) tally.fault({}, "size " + number(static_cast<double>(s)));
            judge_mesh(tally, world, ExactMesh(data), towards({x, x, -z}, {x / 4, -x / 8, z}));
        }
    }
    check(tally, "sizes");
}

}  // namespace limn::mesh_test
