// Somebody else's shapes inside instances: what they hand on to limn's own shapes is decided as exactly as what limn
// hands on itself, and a ray that they have changed is the ray that they say.
#include <thread>

#include "catch.h"
#include "hard/placed.h"

namespace limn::strangers_test {

using namespace test;

namespace {

// Stands beside its inner object: asks it with what `change` makes of the ray.
class Changing final : public Hittable {
public:
    using Change = std::function<Ray(const Ray&)>;
    Changing(Object inner, const Vec3& beside, Change change)
        : inner_(std::move(inner)), beside_(beside), change_(std::move(change)) {}
    Box bounds() const override {
        const Box b = inner_->bounds();
        return grow({b.lower + beside_, b.upper + beside_}, {1e-9, 1e-9, 1e-9});
    }
    std::optional<Hit> hit(const Ray& ray) const override {
        asked = change_(ray);
        auto hit = inner_->hit(asked);
        asked.frame = nullptr;  // ends with this call
        if (hit) hit->element = 0;
        answered = hit;
        return hit;
    }
    mutable Ray asked;
    mutable std::optional<Hit> answered;

private:
    Object inner_;
    Vec3 beside_;
    Change change_;
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

// Asks its inner object on another thread.
class Elsewhere final : public Hittable {
public:
    explicit Elsewhere(Object inner) : inner_(std::move(inner)) {}
    Box bounds() const override { return inner_->bounds(); }
    std::optional<Hit> hit(const Ray& ray) const override {
        std::optional<Hit> hit;
        std::thread([&] { hit = inner_->hit(ray); }).join();
        if (hit) hit->element = 0;
        return hit;
    }

private:
    Object inner_;
};

bool same(const std::optional<RayHit>& a, const std::optional<RayHit>& b) {
    return a.has_value() == b.has_value() && (!a || (a->t == b->t && a->u == b->u && a->v == b->v));
}

// Asks a scene of its own by the ray that it is given, and by the same numbers.
class Window final : public Hittable {
public:
    Window(CompiledScene scene, const Box& bounds) : scene_(std::move(scene)), bounds_(bounds) {}
    Box bounds() const override { return bounds_; }
    std::optional<Hit> hit(const Ray& ray) const override {
        if (!is_usable(ray)) return std::nullopt;
        Ray bare = ray;
        bare.frame = nullptr;
        const auto found = scene_.closest_hit(ray);
        RayHit of_many;
        scene_.closest_hit(std::span(&ray, 1), std::span(&of_many, 1));
        ++asked;
        if (!same(found, scene_.closest_hit(bare)) || found.has_value() != scene_.any_hit(ray) ||
            of_many.t != (found ? found->t : kInfinity))
            ++wrong;
        if (!found) return std::nullopt;
        ++hits;
        const Surface a = scene_.surface_at(ray, *found), b = scene_.surface_at(bare, *found);
        if (a.position != b.position || a.normal != b.normal) ++wrong;
        return Hit{.t = found->t, .normal = a.normal, .u = found->u, .v = found->v};
    }
    mutable int asked = 0, hits = 0, wrong = 0;

private:
    CompiledScene scene_;
    Box bounds_;
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
void judge_wrapped(const std::string& row, std::uint64_t seed, const Wrap& wrap, double rays = 1e5) {
    for (const Placed::Kind kind : kKinds) {
        Random random(seed);
        Tally tally;
        for (int i = 0; i < count(rays); i += 10) {
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

// A change of the rays within an instance, and how far beside its inner object the changing shape stands.
struct RayChange {
    const char* name;
    Vec3 beside;
    Changing::Change change;
};

// By more than an ulp: else it would be the same ray.
RayChange shift_by(const char* name, const Vec3& by) {
    return {name, by, [by](Ray ray) {
                ray.origin = ray.origin - by;
                return ray;
            }};
}

Ray turned(Ray ray) {
    ray.direction = ray.direction + 0x1p-20 * max_abs(ray.direction) * Vec3{1, 1, 1};
    return ray;
}

Ray made_anew(const Ray& r) { return {r.origin, r.direction, r.t_min, r.t_max, r.time}; }

// The changing shape is asked for `inner`, which is asked beside it by the changed ray.
void judge_change(Tally& tally, Random& random, const RayChange& change, const Placed& placed, const Object& inner) {
    const auto changing = std::make_shared<Changing>(inner, change.beside, change.change);
    const auto object = std::make_shared<Instance>(changing, placed.chain[0]);
    Scene scene;
    scene.add(object);
    const CompiledScene compiled = compile(scene);
    const std::vector<Point3> points = placed.awkward_points();
    for (int k = 0; k < 10; ++k) {
        Ray ray = aimed_ray(random, placed, points, 3);
        ray.origin = ray.origin + transform_vector(placed.chain[0], change.beside);
        ++tally.rays, ++tally.judged;
        for (const bool described : {true, false}) {
            changing->asked = {.origin = {0, 0, 0}, .direction = {0, 0, 0}};
            if (described)
                object->hit(ray);
            else
                compiled.closest_hit(ray);
            if (changing->asked.direction == Vec3{}) continue;  // not asked: beside its box
            const auto plain = inner->hit(changing->asked);
            const auto& inside = changing->answered;
            if (plain.has_value() != inside.has_value()) tally.fault(ray, "hit");
            if (!plain || !inside) continue;
            ++tally.hits;
            if (plain->t != inside->t || plain->u != inside->u || plain->v != inside->v) tally.fault(ray, "t, u, v");
        }
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
    judge_wrapped("instance of an instance of pieces of an instance", 9132, [](Random& random, Placed& placed) {
        placed.chain = {skewed(random), skewed(random), skewed(random)};
        const auto inner = std::make_shared<Instance>(placed.shape(), placed.chain[2]);
        const auto pieces = std::make_shared<Instance>(std::make_shared<Piecewise>(inner), placed.chain[1]);
        return std::make_shared<Instance>(pieces, placed.chain[0]);
    });
}

TEST_CASE("Strangers: that ask on another thread are decided exactly too", "[hard][strangers]") {
    const auto wrap = [](Random& random, Placed& placed) {
        placed.chain = {skewed(random), skewed(random)};
        const auto stranger = std::make_shared<Elsewhere>(placed.shape());
        return std::make_shared<Instance>(std::make_shared<Instance>(stranger, placed.chain[1]), placed.chain[0]);
    };
    judge_wrapped("instance of an instance of another thread", 9134, wrap, 2e4);
}

TEST_CASE("Strangers: that change the ray are answered for the ray that they ask, to the bit", "[hard][strangers]") {
    for (const RayChange& change : {shift_by("far", {1, 0, -2}), shift_by("near", {0x1p-20, 0, 0}),
                                    RayChange{"turned", {}, turned}, RayChange{"made anew", {}, made_anew}})
        for (const Placed::Kind kind : kKinds) {
            Random random(9140);
            Tally tally;
            for (int i = 0; i < count(1e5); i += 10) {
                Placed placed = random_shape_of(random, kind);
                placed.chain = {skewed(random)};
                if (random.chance(0.5)) placed.chain.push_back(skewed(random));
                Placed within = placed;
                within.chain.erase(within.chain.begin());
                judge_change(tally, random, change, placed, within.object());
            }
            check(tally, std::string(change.name) + ", kind " + std::to_string(static_cast<int>(kind)));
            CHECK(tally.hits > tally.rays / 10);
        }
}

TEST_CASE("Strangers: that ask a compiled scene are answered for the numbers of the ray alone", "[hard][strangers]") {
    for (const Placed::Kind kind : kKinds) {
        Random random(9150);
        int asked = 0, hits = 0, wrong = 0;
        for (int i = 0; i < count(1e5); i += 10) {
            Placed placed = random_shape_of(random, kind);
            placed.chain = {skewed(random), skewed(random)};
            const Object inner = std::make_shared<Instance>(placed.shape(), placed.chain[1]);
            Scene scene;
            scene.add(random.chance(0.5) ? inner : std::make_shared<Stranger>(inner));
            const auto window = std::make_shared<Window>(compile(scene), inner->bounds());
            const auto object = std::make_shared<Instance>(window, placed.chain[0]);
            const BothWorlds worlds(object);
            const std::vector<Point3> points = placed.awkward_points();
            for (int k = 0; k < 10; ++k) {
                Tally tally;
                worlds.hit(aimed_ray(random, placed, points, 3), tally);
                wrong += tally.wrong > 0;
            }
            asked += window->asked, hits += window->hits, wrong += window->wrong;
        }
        CHECK(wrong == 0);
        CHECK(hits > asked / 10);
    }
}

}  // namespace limn::strangers_test
