// Shapes that coincide, touch, or nearly so: the nearest is the least reported t, and of equals the first.
#include "hard/exact_mesh.h"

namespace limn::closest_test {

using namespace test;

namespace {

struct Item {
    Object object;
    std::function<ExactHit(const Ray&)> exact;
};

Item sphere(const Point3& c, double r) {
    return {ball(c, r), [=](const Ray& ray) { return exact_sphere_hit(c, r, ray); }};
}
Item triangle(const Point3& a, const Point3& b, const Point3& c) {
    return {std::make_shared<Triangle>(a, b, c, nullptr),
            [=](const Ray& ray) { return exact_triangle_hit(a, b, c, ray); }};
}
Item quad(const Point3& p, const Vec3& u, const Vec3& v) {
    return {std::make_shared<Quad>(p, u, v, nullptr), [=](const Ray& ray) { return exact_quad_hit(p, u, v, ray); }};
}

// One primitive an item, so that an element's number is the item's.
void judge_closest(Tally& tally, const std::vector<Item>& items, const std::vector<Ray>& rays) {
    std::vector<Object> objects;
    for (const Item& item : items) objects.push_back(item.object);
    const BothWorlds list(std::make_shared<HittableList>(objects)), tree(std::make_shared<Bvh>(objects));
    for (const Ray& ray : rays) {
        ++tally.rays, ++tally.judged;
        std::optional<Answer> first;
        ExactHit truth;
        for (std::size_t i = 0; i < items.size(); ++i) {
            const auto hit = items[i].object->hit(ray);
            const ExactHit exact = items[i].exact(ray);
            const std::string fault =
                detail::fault_of(exact, hit ? std::optional(Answer{hit->t, hit->u, hit->v, 0}) : std::nullopt, {1, -1});
            if (!fault.empty()) tally.fault(ray, fault);
            if (exact.hit && (!truth.hit || exact.t < truth.t)) truth = exact;
            if (hit && (!first || hit->t < first->t)) first = Answer{hit->t, hit->u, hit->v, i};
        }
        for (const BothWorlds* world : {&list, &tree}) {
            const auto hit = world->hit(ray, tally);
            if (hit.has_value() != first.has_value() || (hit && (hit->t != first->t || hit->element != first->element)))
                tally.fault(ray, "not the first");
            const std::string fault = detail::fault_of(truth, hit, {1, -1});
            if (!fault.empty()) tally.fault(ray, "nearest: " + fault);
        }
        if (first) ++tally.hits;
    }
}

std::vector<Ray> rays_at(Random& random, const std::vector<Point3>& points, const Point3& center, double size) {
    std::vector<Ray> rays;
    for (int n = 0; n < 20; ++n) {
        const Point3 p = points[random.index(points.size())];
        const Point3 eye = center + random.uniform(0, 10) * size * random.unit();
        rays.push_back(towards(eye, p - eye));
        const double step = random.log_uniform(1e-17, 1e-6) * size;
        rays.push_back(towards(eye, p + step * random.unit() - eye));
    }
    return rays;
}

void shuffle(Random& random, std::vector<Item>& items) {
    for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random.index(i)]);
}

}  // namespace

TEST_CASE("Closest: of exact duplicates the first is hit, whatever their order and company", "[hard][closest]") {
    Random random(570);
    Tally tally;
    for (int i = 0; i < count(1e4); ++i) {
        const Point3 p = Point3{} + random.in_cube(random.log_uniform(0.1, 1e4));
        const Vec3 u = random.unit(), v = random.unit();
        std::vector<Item> items;
        for (int n = 0; n < 3; ++n)
            items.insert(items.end(), {sphere(p, 0.5), triangle(p, p + u, p + v), quad(p, u, v), sphere(p + u, 0.25)});
        shuffle(random, items);
        judge_closest(tally, items, rays_at(random, {p, p + u, p + v, p + 0.5 * u, p + 0.3 * u + 0.3 * v}, p, 1));
    }
    check(tally, "duplicates");
    CHECK(tally.hits > tally.rays / 2);
}

TEST_CASE("Closest: surfaces a few doubles apart are told apart as their reported t's are", "[hard][closest]") {
    Random random(571);
    Tally tally;
    for (int i = 0; i < count(1e4); ++i) {
        const Point3 p = Point3{} + random.in_cube(random.log_uniform(0.1, 1e4));
        const Vec3 u = random.unit(), v = random.unit(), n = normalize(cross(u, v));
        std::vector<Item> items;
        for (int k = 0; k < 4; ++k) {
            const double gap = random.log_uniform(1e-18, 1e-9);
            const Point3 q = p + gap * n;
            items.insert(items.end(), {sphere(p + gap * u, 0.5 + gap), sphere(q, 0.5), triangle(q, q + u, q + v),
                                       quad(q, (1 + gap) * u, v), quad(q, u, v + gap * n)});
        }
        shuffle(random, items);
        judge_closest(tally, items, rays_at(random, {p, p + u, p + 0.5 * v, p + 0.2 * u + 0.7 * v}, p, 1));
    }
    check(tally, "neighbours");
    CHECK(tally.hits > tally.rays / 2);
}

TEST_CASE("Closest: spheres that touch, planes that cross and a corner of many shapes are decided exactly",
          "[hard][closest]") {
    Random random(572);
    Tally tally;
    for (int i = 0; i < count(1e4); ++i) {
        const Point3 p{std::round(random.uniform(-50, 50)), 3, -7};
        std::vector<Item> items{sphere(p + Vec3{2, 0, 0}, 2),
                                sphere(p - Vec3{1, 0, 0}, 1),
                                sphere(p + Vec3{0, 4, 0}, 4),
                                sphere(p + Vec3{3, 0, 0}, 3),
                                quad(p, {0, 1, 0}, {0, 0, 1}),
                                quad(p, {1, 0, 0}, {0, 0, 1}),
                                quad(p, {1, 0, 0}, {0, 1, 0}),
                                quad(p - Vec3{1, 1, 1}, {2, 2, 2}, {2, 0, 2}),
                                triangle(p, p + Vec3{1, 0, 0}, p + Vec3{0, 1, 1}),
                                triangle(p - Vec3{1, 0, 0}, p + Vec3{1, 0, 0}, p + Vec3{0, 1, 1})};
        shuffle(random, items);
        judge_closest(tally, items,
                      rays_at(random, {p, p, p + Vec3{1, 0, 0}, p + Vec3{0, 0, 0.5}, p + Vec3{0, 1, 1}}, p, 1));
        const Vec3 whole{std::round(random.uniform(-9, 9)), std::round(random.uniform(-9, 9)), 1};
        judge_closest(tally, items, {towards(p - 4 * whole, whole), towards(p + 4 * whole, -whole)});
    }
    check(tally, "corners");
    CHECK(tally.hits > tally.rays / 2);
}

TEST_CASE("Closest: of a mesh that holds each triangle three times the last copy is never reported",
          "[hard][closest]") {
    Random random(573);
    MeshData data = icosphere(2);
    const std::size_t once = data.triangles.size();
    const std::vector<Index3> copy = data.triangles;
    for (const Index3& t : copy) data.triangles.push_back({t.b, t.c, t.a});  // the same triangle, turned
    for (const Index3& t : copy) data.triangles.push_back(t);
    const BothWorlds world(std::make_shared<Mesh>(data, nullptr));
    const ExactMesh exact(data);
    Tally tally;
    for (int i = 0; i < count(2e5); ++i) {
        const Point3 a = vertex(data, copy[random.index(once)].a), b = vertex(data, copy[random.index(once)].b);
        const Point3 eye = Point3{} + 3 * random.unit();
        const Ray ray = towards(eye, (random.chance(0.5) ? a : a + random.uniform() * (b - a)) - eye);
        if (i % 10 == 0)
            judge_mesh(tally, world, exact, ray);
        else
            ++tally.rays, ++tally.judged;
        const auto hit = world.hit(ray, tally);
        if (hit && hit->element >= 2 * once) tally.fault(ray, "the last copy");
    }
    check(tally, "copies");
}

}  // namespace limn::closest_test
