// Small scenes of every kind, for tests that compare two ways to trace the same thing.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "limn/scene/material/lambertian.h"
#include "limn/scene/scene.h"
#include "limn/scene/shape/bvh.h"
#include "limn/scene/shape/constant_medium.h"
#include "limn/scene/shape/hittable_list.h"
#include "limn/scene/shape/instance.h"
#include "limn/scene/shape/mesh.h"
#include "limn/scene/shape/quad.h"
#include "limn/scene/shape/sphere.h"
#include "limn/scene/shape/triangle.h"
#include "support/meshes.h"
#include "support/random_geometry.h"

namespace limn::test {

using Object = std::shared_ptr<const Hittable>;

/// Somebody else's class: whatever it holds is one primitive that limn knows nothing about.
class Stranger final : public Hittable {
public:
    explicit Stranger(Object inner) : inner_(std::move(inner)) {}
    Box bounds() const override { return inner_->bounds(); }
    std::optional<Hit> hit(const Ray& ray) const override {
        std::optional<Hit> hit = inner_->hit(ray);
        if (hit) hit->element = 0;
        return hit;
    }

private:
    Object inner_;
};

/// y = 0, everywhere: a user's shape without bounds.
class Floor final : public Hittable {
public:
    Box bounds() const override { return {{-kInfinity, 0, -kInfinity}, {kInfinity, 0, kInfinity}}; }
    std::optional<Hit> hit(const Ray& ray) const override {
        const double t = -ray.origin.y / ray.direction.y;
        if (!is_usable(ray) || ray.direction.y == 0 || !(t > ray.t_min && t <= ray.t_max)) return std::nullopt;
        return Hit{.t = t, .normal = {0, 1, 0}, .u = 0.5, .v = 0.25};
    }
};

struct ZooScene {
    std::string name;
    Scene scene;
    Targets targets;
};

inline Object ball(const Point3& c, double r) { return std::make_shared<Sphere>(c, r, nullptr); }

/// A shape of one kind at random. Kinds: 0 sphere, 1 moving sphere, 2 triangle, 3 quad, 4 mesh.
inline Object random_shape(Random& random, std::size_t kind, double spread = 5) {
    const Point3 p = Point3{} + random.in_cube(spread);
    switch (kind) {
        case 0: return ball(p, random.sign() * random.uniform(0.1, 1.5));
        case 1: return std::make_shared<Sphere>(p, p + random.in_cube(2), random.uniform(0.1, 1), nullptr);
        case 2: return std::make_shared<Triangle>(p, p + random.in_cube(3), p + random.in_cube(3), nullptr);
        case 3: return std::make_shared<Quad>(p, random.in_cube(3), random.in_cube(3), nullptr);
        default: return std::make_shared<Mesh>(icosphere(1, random.uniform(0.2, 2), p - Point3{}), nullptr);
    }
}

inline Transform random_pose(Random& random, double spread = 4) {
    const double x = random.sign() * random.log_uniform(0.3, 3), y = random.log_uniform(0.3, 3),
                 z = random.log_uniform(0.3, 3);
    return Transform::translate(random.in_cube(spread)) * Transform::rotate(random.unit(), random.uniform(0, 360)) *
           Transform::scale(x, y, z);
}

/// The same pose a little later; between the two it never collapses.
inline Transform moved_pose(Random& random, const Transform& m) {
    return Transform::translate(random.in_cube(1)) * m * Transform::rotate(random.unit(), random.uniform(-40, 40));
}

inline Object random_instance(Random& random, const Object& object) {
    const Transform m = random_pose(random);
    if (random.chance(0.5)) return std::make_shared<Instance>(object, m);
    return std::make_shared<Instance>(object, m, moved_pose(random, m));
}

/// Anything, down to `depth` levels of nesting. Boundaries of media hold no media.
inline Object random_object(Random& random, int depth, bool with_media = true) {
    std::size_t kind = random.index(depth > 0 ? 10 : 5);
    if (kind == 7 && !with_media) kind = 8;
    if (kind < 5) return random_shape(random, kind, 3);
    const Object inner = random_object(random, depth - 1, with_media && kind != 7);
    if (kind == 5) return random_instance(random, inner);
    if (kind == 6) return std::make_shared<Stranger>(inner);
    if (kind == 7) return std::make_shared<ConstantMedium>(inner, 0.5, Color{1, 1, 1});
    const std::vector<Object> objects{inner, random_object(random, depth - 1, with_media), inner};
    if (kind == 8) return std::make_shared<HittableList>(objects);
    return std::make_shared<Bvh>(objects);
}

/// Centres and corners of the boxes, as targets where nothing better is known.
inline void aim_at_boxes(ZooScene& zoo) {
    for (const Object& object : zoo.scene.objects()) {
        const Box b = object->bounds();
        if (b.is_empty() || !is_finite(b.lower) || !is_finite(b.upper)) continue;
        zoo.targets.region.extend(b);
        zoo.targets.points.insert(zoo.targets.points.end(),
                                  {b.center(), b.lower, b.upper, {b.center().x, b.upper.y, b.center().z}});
    }
    if (zoo.targets.points.empty()) zoo.targets = {{{-1, -1, -1}, {1, 1, 1}}, {{0, 0, 0}}};
}

inline ZooScene zoo_of(const std::string& name, const std::vector<Object>& objects) {
    ZooScene zoo{name, {}, {}};
    zoo.scene.name = name;
    for (const Object& object : objects) zoo.scene.add(object);
    aim_at_boxes(zoo);
    return zoo;
}

/// Many of one kind, every tenth twice, with rays at what the shapes are made of.
inline ZooScene zoo_of_kind(const std::string& name, std::size_t kind, std::size_t count, std::uint64_t seed) {
    Random random(seed);
    std::vector<Object> objects;
    std::vector<Point3> points;
    for (std::size_t i = 0; i < count; ++i) {
        const Point3 p = Point3{} + random.in_cube(5);
        const Vec3 e = random.in_cube(3), f = random.in_cube(3);
        switch (kind) {
            case 2: objects.push_back(std::make_shared<Triangle>(p, p + e, p + f, nullptr)); break;
            case 3: objects.push_back(std::make_shared<Quad>(p, e, f, nullptr)); break;
            default: objects.push_back(random_shape(random, kind)); break;
        }
        if (kind == 2 || kind == 3) points.insert(points.end(), {p, p + e, p + f, p + 0.5 * e, p + e + f});
        if (i % 10 == 9) objects.push_back(objects[i / 2]);
    }
    ZooScene zoo = zoo_of(name, objects);
    zoo.targets.points.insert(zoo.targets.points.end(), points.begin(), points.end());
    return zoo;
}

inline ZooScene zoo_mesh() {
    MeshData data = icosphere(2);
    for (const Float3& p : data.vertices) {
        data.normals.push_back({2 * p.x, 2 * p.y, 2 * p.z});
        data.uvs.push_back({p.x, p.y});
    }
    data.triangles.insert(data.triangles.begin() + 7, {{0, 0, 1}, {5, 5, 5}});  // without area
    ZooScene zoo = zoo_of(
        "mesh", {std::make_shared<Mesh>(data, nullptr), std::make_shared<Mesh>(cube_mesh(4, {-2, -2, -2}), nullptr),
                 std::make_shared<Mesh>(u_shape(), nullptr)});
    for (std::uint32_t i = 0; i < data.vertices.size(); ++i) zoo.targets.points.push_back(vertex(data, i));
    for (std::uint32_t i = 0; i < 16; ++i) zoo.targets.points.push_back(vertex(u_shape(), i));
    return zoo;
}

/// Instances in instances in instances, still and moving, mirrored, shared.
inline ZooScene zoo_instances() {
    Random random(205);
    const Object mesh = std::make_shared<Mesh>(icosphere(1), nullptr);
    std::vector<Object> objects;
    for (int i = 0; i < 15; ++i) {
        Object object = i % 3 ? mesh : random_shape(random, random.index(4), 1);
        for (std::size_t level = 0; level <= random.index(4); ++level) object = random_instance(random, object);
        objects.push_back(object);
    }
    objects.push_back(std::make_shared<Instance>(mesh, Transform::scale(-1, 1, 1)));
    objects.push_back(std::make_shared<Instance>(mesh, Transform::rotate_y(90)));
    objects.push_back(std::make_shared<Instance>(mesh, Transform{}));  // these three overlap in many vertices
    return zoo_of("instances", objects);
}

/// Boundaries of media: convex, not convex, hollow, nested, instanced, shared, from a user's own shape.
inline ZooScene zoo_media() {
    const Object u = std::make_shared<Mesh>(u_shape(), nullptr);
    const auto fog = [](const Object& boundary) {
        return std::make_shared<ConstantMedium>(boundary, 0.5, Color{0.5, 0.5, 0.5});
    };
    const Object shell = std::make_shared<HittableList>(std::vector<Object>{ball({0, 0, 0}, 2), ball({0, 0, 0}, -1)});
    return zoo_of(
        "media",
        {fog(ball({0, 0, 0}, 3)), ball({0, 0, 0}, 1), fog(u),
         std::make_shared<Instance>(fog(u), Transform::translate({-3, 0, 0}) * Transform::rotate_y(30)),
         fog(std::make_shared<Instance>(u, Transform::translate({1, -2, 0}), Transform::translate({2, -2, 0}))),
         fog(shell), fog(std::make_shared<Stranger>(shell)),
         std::make_shared<HittableList>(
             std::vector<Object>{ball({5, 5, 0}, 1), fog(make_box({-5, -5, -5}, {-3, -3, -3}, nullptr))})});
}

inline ZooScene zoo_strangers() {
    Random random(206);
    std::vector<Object> objects;
    for (int i = 0; i < 20; ++i) {
        const Object object = std::make_shared<Stranger>(random_shape(random, random.index(5)));
        objects.push_back(i % 4 ? object : random_instance(random, object));
    }
    return zoo_of("strangers", objects);
}

/// Everything at once, nested.
inline ZooScene zoo_mixed(std::uint64_t seed) {
    Random random(seed);
    std::vector<Object> objects;
    for (int i = 0; i < 12; ++i) objects.push_back(random_object(random, 3));
    objects.push_back(objects[random.index(objects.size())]);
    return zoo_of("mixed " + std::to_string(seed), objects);
}

/// A millimetre of mesh a hundred kilometres out, inside a huge ground sphere, among small balls.
inline ZooScene zoo_scales() {
    Random random(207);
    std::vector<Object> objects{ball({0, -1e6, 0}, 1e6),
                                std::make_shared<Mesh>(icosphere(1, 1e-3, {1e5, 0, 0}), nullptr)};
    for (int i = 0; i < 200; ++i)
        objects.push_back(
            ball(Point3{1e5, 0, 0} + random.in_cube(random.log_uniform(1e-2, 10)), random.log_uniform(1e-4, 1e-1)));
    ZooScene zoo = zoo_of("scales", objects);
    zoo.targets.region = {{1e5 - 10, -10, -10}, {1e5 + 10, 10, 10}};
    return zoo;
}

}  // namespace limn::test
