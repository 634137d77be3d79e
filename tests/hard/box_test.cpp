// Boxes: whatever meets the closed box in exact arithmetic is let through, by the slab test and by the trees of both
// worlds: in special configurations (rays along edges, flat boxes, origins on a face), and at corners and edges of
// small boxes far from the origin.
#include <array>

#include "geometry/bvh/slab.h"
#include "hard/hard.h"
#include "limn/scene/shape/bvh.h"
#include "support/random_geometry.h"

namespace limn::box_test {

using namespace test;

namespace {

bool slab_meets(const Box& box, const Ray& ray) {
    double near = 0;
    return accel::SlabRay(ray, accel::finite_extent(box)).meets(box, ray.t_max, near);
}

// Somebody else's shape that fills its box and counts who comes in.
class Doorman final : public Hittable {
public:
    explicit Doorman(const Box& box) : box_(box) {}
    Box bounds() const override { return box_; }
    std::optional<Hit> hit(const Ray&) const override {
        ++calls;
        return std::nullopt;
    }
    mutable int calls = 0;

private:
    Box box_;
};

// Counts as lost what meets the box and is not let in.
void ask(const Box& box, const Ray& ray, Tally& tally) {
    ++tally.rays, ++tally.judged;
    if (!is_usable(ray)) return tally.fault(ray, "not a ray");
    if (!exact_box_hit(box, ray)) return;
    ++tally.hits;
    if (!slab_meets(box, ray)) tally.fault(ray, "lost by the slab test");
}

// The same through the trees, between two other boxes.
void ask_trees(const Box& box, const Ray& ray, Tally& tally) {
    ++tally.rays, ++tally.judged;
    if (!exact_box_hit(box, ray)) return;
    ++tally.hits;
    const auto doorman = std::make_shared<Doorman>(box);
    const Vec3 aside = 3 * box.diagonal() + Vec3{1, 1, 1};
    std::vector<std::shared_ptr<const Hittable>> objects{doorman};
    for (const double side : {-1.0, 1.0})
        objects.push_back(std::make_shared<Doorman>(Box{box.lower + side * aside, box.upper + side * aside}));
    Bvh(objects).hit(ray);
    if (doorman->calls != 1) tally.fault(ray, "lost by the described tree");
    Scene scene;
    for (const auto& object : objects) scene.add(object);
    compile(scene).any_hit(ray);
    if (doorman->calls != 2) tally.fault(ray, "lost by the compiled tree");
}

double one_of(Random& random, double a, double b) { return random.chance(0.5) ? a : b; }

Box random_box(Random& random, double size, double place) {
    Box box;
    for (std::size_t a = 0; a < 3; ++a) {
        box.lower[a] = place + size * random.uniform(-1, 1);
        box.upper[a] = box.lower[a] + size * random.uniform(0.1, 1);
    }
    return box;
}

Point3 corner(Random& random, const Box& box) {
    const double x = one_of(random, box.lower.x, box.upper.x), y = one_of(random, box.lower.y, box.upper.y);
    return {x, y, one_of(random, box.lower.z, box.upper.z)};
}

// The special configurations: each makes a ray that meets the box.
struct Configuration {
    const char* name;
    void (*make)(Random&, Box&, Ray&);
};

double signed_zero(Random& random) { return one_of(random, 0.0, -0.0); }

// Along `axis` from outside or from within, at a point of the box in the other two.
void along_an_axis(Random& random, const Box& box, std::size_t axis, const Point3& through, Ray& ray) {
    const double sign = random.sign();
    for (std::size_t a = 0; a < 3; ++a) {
        ray.origin[a] = through[a];
        ray.direction[a] = signed_zero(random);
    }
    ray.direction[axis] = sign * random.uniform(0.1, 2);
    ray.origin[axis] = (sign > 0 ? box.lower : box.upper)[axis] - sign * random.uniform(0, 3);
}

const Configuration kConfigurations[] = {
    {"in the low face, parallel to an axis",
     [](Random& random, Box& box, Ray& ray) {
         const std::size_t axis = random.index(3);
         Point3 p = random.in_box(box);
         p[(axis + 1) % 3] = box.lower[(axis + 1) % 3];
         along_an_axis(random, box, axis, p, ray);
     }},
    {"in the high face, parallel to an axis",
     [](Random& random, Box& box, Ray& ray) {
         const std::size_t axis = random.index(3);
         Point3 p = random.in_box(box);
         p[(axis + 1) % 3] = box.upper[(axis + 1) % 3];
         along_an_axis(random, box, axis, p, ray);
     }},
    {"along an edge",
     [](Random& random, Box& box, Ray& ray) { along_an_axis(random, box, random.index(3), corner(random, box), ray); }},
    {"one zero component, from a point of the face",
     [](Random& random, Box& box, Ray& ray) {
         const std::size_t axis = random.index(3);
         ray.origin = random.in_box(box);
         ray.origin[axis] = one_of(random, box.lower[axis], box.upper[axis]);
         ray.direction = random.unit();
         ray.direction[axis] = signed_zero(random);
     }},
    {"across a flat box",
     [](Random& random, Box& box, Ray& ray) {
         const std::size_t axis = random.index(3);
         box.upper[axis] = box.lower[axis];
         along_an_axis(random, box, axis, random.in_box(box), ray);
     }},
    {"within a flat box",
     [](Random& random, Box& box, Ray& ray) {
         const std::size_t axis = random.index(3);
         box.upper[axis] = box.lower[axis];
         ray.origin = random.in_box(box);
         ray.direction = random.unit();
         ray.direction[axis] = signed_zero(random);
     }},
    {"from a flat box, leaving",
     [](Random& random, Box& box, Ray& ray) {
         const std::size_t axis = random.index(3);
         box.upper[axis] = box.lower[axis];
         ray.origin = random.in_box(box);
         ray.direction = random.unit();
     }},
    {"from a face, leaving",
     [](Random& random, Box& box, Ray& ray) {
         const std::size_t axis = random.index(3);
         const double sign = random.sign();
         ray.origin = random.in_box(box);
         ray.origin[axis] = (sign > 0 ? box.upper : box.lower)[axis];
         ray.direction = random.unit();
         ray.direction[axis] = sign * std::abs(ray.direction[axis]);
     }},
    {"from a corner",
     [](Random& random, Box& box, Ray& ray) {
         ray.origin = corner(random, box);
         ray.direction = random.unit();
     }},
    {"from an edge, along an axis",
     [](Random& random, Box& box, Ray& ray) {
         const std::size_t axis = random.index(3);
         ray.origin = corner(random, box);
         ray.direction = {signed_zero(random), signed_zero(random), signed_zero(random)};
         ray.direction[axis] = random.sign();
     }},
    {"through a box that is a segment",
     [](Random& random, Box& box, Ray& ray) {
         const std::size_t axis = random.index(3), other = (axis + 1) % 3;
         box.upper[axis] = box.lower[axis], box.upper[other] = box.lower[other];
         along_an_axis(random, box, axis, random.in_box(box), ray);
     }},
    {"through a box that is a point",
     [](Random& random, Box& box, Ray& ray) {
         box.upper = box.lower;
         along_an_axis(random, box, random.index(3), box.lower, ray);
     }},
    {"a direction of 1e-30 or 1e25 of its length, from within",
     [](Random& random, Box& box, Ray& ray) {
         ray.origin = random.in_box(box);
         ray.direction = one_of(random, 0x1p-100, 0x1p84) * random.unit();
     }},
    {"an interval that ends where the box begins, and one that begins where it ends",
     [](Random& random, Box& box, Ray& ray) {
         for (std::size_t a = 0; a < 3; ++a) {  // whole numbers, so that the ends are exact
             box.lower[a] = std::floor(box.lower[a]);
             box.upper[a] = box.lower[a] + 1 + static_cast<double>(random.index(4));
         }
         const std::size_t axis = random.index(3);
         along_an_axis(random, box, axis, random.in_box(box), ray);
         const bool forward = ray.direction[axis] > 0;
         ray.direction[axis] = forward ? 1 : -1;
         ray.origin[axis] = forward ? box.lower[axis] - 2 : box.upper[axis] + 2;
         if (random.chance(0.5))
             ray.t_max = 2;
         else
             ray.t_min = 2 + box.diagonal()[axis];
     }},
};

}  // namespace

TEST_CASE("Box: rays in faces and edges, in flat boxes, from the border and with zeros of either sign meet it",
          "[hard][box]") {
    for (const Configuration& configuration : kConfigurations) {
        Random random(2900);
        Tally tally;
        for (int i = 0; i < count(1e5); ++i) {
            const double scale = one_of(random, 1, 1e-3), place = 1e3 * static_cast<double>(random.index(3));
            Box box = random_box(random, scale, place);
            Ray ray;
            configuration.make(random, box, ray);
            ask(box, ray, tally);
            if (i % 10 == 0) ask_trees(box, ray, tally);
        }
        check(tally, configuration.name);
        CHECK(tally.hits == tally.rays);
    }
}

TEST_CASE("Box: rays aimed at corners, edges and inner points meet it, near and far, large and small", "[hard][box]") {
    Random random(3000);
    for (const double place : {0.0, 1e3, 1e5, 1e9})
        for (const double size : {1.0, 1e-3}) {
            Tally tally;
            const int rays = count(1e7) / 8;
            for (int i = 0; i < rays; ++i) {
                const Box box = random_box(random, size, place);
                Point3 target = random.in_box(box);
                for (std::size_t a = 0; a < 3; ++a)
                    if (random.chance(0.6)) target[a] = one_of(random, box.lower[a], box.upper[a]);
                Ray ray;
                ray.origin = target + 10 * size * random.in_cube();
                ray.direction = target - ray.origin;
                if (ray.direction == Vec3{}) ray.direction = {1, 0, 0};
                if (random.chance(0.2)) ray.t_max = 1;
                if (random.chance(0.2)) ray.t_min = 1;
                ask(box, ray, tally);
            }
            check(tally, "place " + std::to_string(place) + ", size " + std::to_string(size));
            CHECK(tally.hits > tally.rays / 4);
        }
}

TEST_CASE("Box: in half-open worlds, among numbers up to 3e38 and subnormal ones, no ray is lost", "[hard][box]") {
    const double values[] = {0,  -0.0, 5e-324, -5e-324, 1e-310,    0x1p-1022,  -1e-30, 1e-30,    1,
                             -1, 3e38, -3e38,  1e30,    kInfinity, -kInfinity, 0.1,    16777216, -123456.789};
    const double tiny[] = {0, -0.0, 5e-324, -5e-324, 1e-310, -3e-309, 0x1p-1022, -0x1p-1021, 0x1.8p-1060, 1e-300};
    Random random(3001);
    bool all_tiny = false;
    const auto value = [&] {
        return all_tiny ? tiny[random.index(std::size(tiny))] : values[random.index(std::size(values))];
    };
    const auto finite = [&] {
        for (;;)
            if (const double x = value(); std::isfinite(x)) return x;
    };
    Tally tally;
    const int rays = count(1e7);
    for (int i = 0; i < rays; ++i) {
        all_tiny = random.chance(0.3);
        Box box;
        for (std::size_t a = 0; a < 3; ++a) {
            const double p = random.chance(0.2) ? random.uniform(-2, 2) : value();
            const double q = random.chance(0.2) ? random.uniform(-2, 2) : value();
            box.lower[a] = std::min(p, q), box.upper[a] = std::max(p, q);
            if (box.lower[a] == kInfinity) box.lower[a] = 0;
            if (box.upper[a] == -kInfinity) box.upper[a] = 0;
        }
        Ray ray;
        for (std::size_t a = 0; a < 3; ++a) ray.origin[a] = finite(), ray.direction[a] = finite();
        if (random.chance(0.5)) {
            // Aimed at a corner, as far as doubles go.
            Point3 target = corner(random, box);
            for (std::size_t a = 0; a < 3; ++a)
                if (!std::isfinite(target[a]) || !std::isfinite(target[a] - ray.origin[a])) target[a] = ray.origin[a];
            ray.direction = target - ray.origin;
        }
        if (ray.direction == Vec3{}) ray.direction.x = 1;
        if (random.chance(0.3)) ray.t_max = std::max(0.0, value());
        if (random.chance(0.3)) ray.t_min = -kInfinity;
        ask(box, ray, tally);
    }
    check(tally, "all magnitudes");
    CHECK(tally.hits > tally.rays / 10);
}

}  // namespace limn::box_test
