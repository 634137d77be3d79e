// Somebody else's shapes inside instances: what they hand on to limn's own shapes is decided as exactly as what limn
// hands on itself, and a ray that they have changed is the ray that they say.
#include "catch.h"
#include "hard/placed.h"

using namespace limn;
using namespace limn::test;

namespace {

// Stands beside its inner object: asks it with another origin.
class Shifted final : public Hittable {
public:
    Shifted(Object inner, const Vec3& by) : inner_(std::move(inner)), by_(by) {}
    Box bounds() const override {
        const Box b = inner_->bounds();
        return grow({b.lower + by_, b.upper + by_}, {1e-9, 1e-9, 1e-9});
    }
    std::optional<Hit> hit(const Ray& ray) const override {
        asked = ray;
        asked.origin = ray.origin - by_;
        auto hit = inner_->hit(asked);
        if (hit) hit->element = 0;
        answered = hit;
        return hit;
    }
    mutable Ray asked;
    mutable std::optional<Hit> answered;

private:
    Object inner_;
    Vec3 by_;
};

// Looks for its inner object piecewise, as a user's own tree may: the same ray with other ends.
class Piecewise final : public Hittable {
public:
    explicit Piecewise(Object inner) : inner_(std::move(inner)) {}
    Box bounds() const override { return inner_->bounds(); }
    std::optional<Hit> hit(const Ray& ray) const override {
        std::optional<Hit> hit;
        for (double first = ray.t_min; !hit && first < ray.t_max;) {
            Ray piece = ray;
            piece.t_min = first;
            piece.t_max = std::min(ray.t_max, first < 1 ? (first < 0.5 ? 0.5 : 1.0) : kInfinity);
            hit = inner_->hit(piece);
            first = piece.t_max;
        }
        if (hit) hit->element = 0;
        return hit;
    }

private:
    Object inner_;
};

Transform skewed(Random& random) {
    Transform m;
    for (auto& row : m.rows)
        for (double& x : row) x = random.uniform(-0.4, 0.4);
    for (std::size_t i = 0; i < 3; ++i) m.rows[i][i] = random.sign() * random.uniform(1, 2);
    return Transform::translate(random.in_cube(1e3)) * m;
}

Placed random_shape_of(Random& random, Placed::Kind kind) {
    Placed placed;
    placed.kind = kind;
    placed.p = Point3{} + random.in_cube();
    placed.e = random.in_cube(), placed.f = random.in_cube();
    return placed;
}

constexpr Placed::Kind kKinds[] = {Placed::Kind::sphere, Placed::Kind::triangle, Placed::Kind::quad};

// `wrap` makes the object of the shape; `rays` rays at each kind.
template <class Wrap>
void judge_wrapped(const std::string& row, std::uint64_t seed, const Wrap& wrap) {
    for (const Placed::Kind kind : kKinds) {
        Random random(seed);
        Tally tally;
        for (int i = 0; i < count(1e5); i += 10) {
            Placed placed = random_shape_of(random, kind);
            const Object object = wrap(random, placed);
            const BothWorlds worlds(object, {ball({0, 0, -7000}, 1)});
            const std::vector<Point3> points = placed.awkward_points();
            for (int k = 0; k < 10; ++k) judge(tally, placed, worlds, aimed_ray(random, placed, points, 3));
        }
        check(tally, row + ", kind " + std::to_string(static_cast<int>(kind)));
        CHECK(tally.hits > tally.rays / 10);
    }
}

}  // namespace

TEST_CASE("Strangers: in an instance, around limn's shapes or around instances of them, are decided exactly",
          "[hard][strangers]") {
    judge_wrapped("instance of a stranger", 9100, [](Random& random, Placed& placed) {
        placed.chain = {skewed(random)};
        return std::make_shared<Instance>(std::make_shared<Stranger>(placed.shape()), placed.chain[0]);
    });
    judge_wrapped("instance of a stranger around an instance", 9110, [](Random& random, Placed& placed) {
        placed.chain = {skewed(random), skewed(random)};
        const auto inner = std::make_shared<Instance>(placed.shape(), placed.chain[1]);
        return std::make_shared<Instance>(std::make_shared<Stranger>(inner), placed.chain[0]);
    });
    judge_wrapped("instance of a tree of a stranger around a list", 9120, [](Random& random, Placed& placed) {
        placed.chain = {skewed(random)};
        const auto list = std::make_shared<HittableList>(std::vector<Object>{placed.shape()});
        const auto tree = std::make_shared<Bvh>(std::vector<Object>{std::make_shared<Stranger>(list)});
        return std::make_shared<Instance>(tree, placed.chain[0]);
    });
}

TEST_CASE("Strangers: that ask piece by piece are decided exactly too", "[hard][strangers]") {
    judge_wrapped("instance of pieces", 9130, [](Random& random, Placed& placed) {
        placed.chain = {skewed(random)};
        return std::make_shared<Instance>(std::make_shared<Piecewise>(placed.shape()), placed.chain[0]);
    });
}

TEST_CASE("Strangers: that change the ray are answered for the ray that they ask, to the bit", "[hard][strangers]") {
    Random random(9140);
    for (const Placed::Kind kind : kKinds) {
        Tally tally;
        for (int i = 0; i < count(1e5); i += 10) {
            Placed placed = random_shape_of(random, kind);
            placed.chain = {skewed(random)};
            // Far, and by little; not by less than an ulp, which would be the same ray.
            const Vec3 by = random.chance(0.5) ? Vec3{1, 0, -2} : Vec3{0x1p-20, 0, 0};
            const Object shape = placed.shape();
            const auto shifted = std::make_shared<Shifted>(shape, by);
            const auto object = std::make_shared<Instance>(shifted, placed.chain[0]);
            Scene scene;
            scene.add(object);
            const CompiledScene compiled = compile(scene);
            const std::vector<Point3> points = placed.awkward_points();
            for (int k = 0; k < 10; ++k) {
                Ray ray = aimed_ray(random, placed, points, 3);
                ray.origin = ray.origin + transform_vector(placed.chain[0], by);
                ++tally.rays, ++tally.judged;
                for (const bool described : {true, false}) {
                    shifted->asked = {.origin = {0, 0, 0}, .direction = {0, 0, 0}};
                    if (described)
                        object->hit(ray);
                    else
                        compiled.closest_hit(ray);
                    if (shifted->asked.direction == Vec3{}) continue;  // not asked: beside its box
                    const auto plain = shape->hit(shifted->asked);
                    const auto& inside = shifted->answered;
                    if (plain.has_value() != inside.has_value()) tally.fault(ray, "hit");
                    if (!plain || !inside) continue;
                    ++tally.hits;
                    if (plain->t != inside->t || plain->u != inside->u || plain->v != inside->v)
                        tally.fault(ray, "t, u, v");
                }
            }
        }
        check(tally, "kind " + std::to_string(static_cast<int>(kind)));
        CHECK(tally.hits > tally.rays / 10);
    }
}
