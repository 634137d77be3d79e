// What a shape's hits may not depend on: where the scene stands, how large it is, how its axes are called, which way
// the ray is walked. On numbers of few bits (support/grid.h) most of these laws hold to the bit.
#include "catch.h"
#include "geometry/filter.h"
#include "limn/scene/shape/instance.h"
#include "property.h"
#include "support/cases.h"

namespace limn::invariance_test {

using test::Case;
using test::draw_case;
using test::draw_int;
using test::draw_point;
using test::draw_power_of_two;
using test::draw_vec;
using test::Kind;

namespace {

// Counts what the law was tried on, so that it cannot hold by never hitting.
template <class Law>
void holds_for_hits(const Law& law) {
    int hits = 0;
    test::holds([&] { hits += law(draw_case()); }, 1000);
    CHECK(hits >= 250);
}

bool same_to_the_bit(const std::optional<Hit>& a, const std::optional<Hit>& b, double t_factor = 1) {
    if (a.has_value() != b.has_value()) return false;
    return !a || (a->t * t_factor == b->t && a->u == b->u && a->v == b->v && a->element == b->element);
}

// As far as t, u and v may be off: the filter's own answers and those of the exact stage differ so much at most.
bool same_but_for_rounding(const std::optional<Hit>& a, const std::optional<Hit>& b) {
    if (a.has_value() != b.has_value()) return false;
    return !a || (std::abs(a->t - b->t) <= kAccurate * std::abs(a->t) && std::abs(a->u - b->u) <= kAccurateWeight &&
                  std::abs(a->v - b->v) <= kAccurateWeight && a->element == b->element);
}

bool nearly(const Vec3& a, const Vec3& b) { return length(a - b) <= gamma(16); }

}  // namespace

TEST_CASE("Shapes: moved together, shape and ray meet as before, to the bit", "[shape][invariance]") {
    holds_for_hits([](const Case& c) {
        const auto a = c.hit(), b = c.moved(64 * draw_vec()).hit();  // by whole numbers
        RC_ASSERT(same_to_the_bit(a, b));
        if (a) RC_ASSERT(a->normal == b->normal);
        return a.has_value();
    });
}

TEST_CASE("Shapes: at 2^k times the size everything is hit at 2^k times the t, to the bit", "[shape][invariance]") {
    holds_for_hits([](const Case& c) {
        const double s = draw_power_of_two(-100, 100);  // round values of t are those of float32
        const auto a = c.hit(), b = c.scaled(s).hit();
        RC_ASSERT(same_to_the_bit(a, b, s));
        if (a) RC_ASSERT(a->normal == b->normal);
        if (a) RC_ASSERT(s * a->position_error == b->position_error);
        return a.has_value();
    });
}

TEST_CASE("Shapes: a direction 2^k times as long is hit at 2^-k times the t, to the bit", "[shape][invariance]") {
    holds_for_hits([](const Case& c) {
        const double s = draw_power_of_two(-100, 100);
        Case longer = c;
        longer.ray.direction = s * c.ray.direction;
        const auto a = c.hit(), b = longer.hit();
        RC_ASSERT(same_to_the_bit(a, b, 1 / s));
        if (a) RC_ASSERT(nearly(Vec3(a->normal), Vec3(b->normal)));
        return a.has_value();
    });
}

TEST_CASE("Shapes: axes may change their names and signs: planar shapes are hit alike to the bit",
          "[shape][invariance]") {
    holds_for_hits([](const Case& c) {
        RC_PRE(c.kind != Kind::sphere);
        const Vec3 d = limn::abs(c.ray.direction);
        RC_PRE((d.x != d.y && d.y != d.z && d.z != d.x));  // of equal components the last is divided by
        std::size_t axes[3] = {0, 1, 2};
        std::swap(axes[0], axes[static_cast<std::size_t>(draw_int(0, 2))]);
        std::swap(axes[1], axes[static_cast<std::size_t>(draw_int(1, 2))]);
        const int signs = draw_int(0, 7);
        const auto renamed = [&](const Vec3& v) {
            Vec3 r;
            for (std::size_t a = 0; a < 3; ++a) r[axes[a]] = (signs >> a) & 1 ? -v[a] : v[a];
            return r;
        };
        Case other = c;
        other.p = Point3{} + renamed(c.p - Point3{});
        other.e = renamed(c.e), other.f = renamed(c.f);
        other.ray.origin = Point3{} + renamed(c.ray.origin - Point3{});
        other.ray.direction = renamed(c.ray.direction);
        const auto a = c.hit(), b = other.hit();
        RC_ASSERT(same_to_the_bit(a, b));
        // A mirror turns e x f against the mirrored normal.
        const double turn = dot(cross(renamed({1, 0, 0}), renamed({0, 1, 0})), renamed({0, 0, 1}));
        if (a) RC_ASSERT(nearly(turn * renamed(Vec3(a->normal)), Vec3(b->normal)));
        return a.has_value();
    });
}

TEST_CASE("Shapes: with its edges swapped a planar shape swaps u and v and turns its normal", "[shape][invariance]") {
    holds_for_hits([](const Case& c) {
        RC_PRE(c.kind != Kind::sphere);
        Case swapped = c;
        std::swap(swapped.e, swapped.f);
        const auto a = c.hit(), b = swapped.hit();
        RC_ASSERT(a.has_value() == b.has_value());
        if (!a) return false;
        // The same terms in another order; they cancel where the ray grazes.
        const double grazing = std::abs(dot(a->normal, normalize(c.ray.direction)));
        RC_ASSERT(std::abs(a->t - b->t) * grazing <= 1e-13);
        RC_ASSERT((std::abs(a->u - b->v) * grazing <= 1e-11 && std::abs(a->v - b->u) * grazing <= 1e-11));
        RC_ASSERT(a->normal == -b->normal);
        RC_ASSERT(a->position_error == b->position_error);
        return true;
    });
}

TEST_CASE("Shapes: walked backwards a segment meets the same surfaces in reverse order", "[shape][invariance]") {
    holds_for_hits([](const Case& c) {
        Ray forward = c.ray;
        forward.origin = c.ray.origin - c.ray.direction;  // on both sides of the target
        forward.direction = 3 * c.ray.direction;
        forward.t_max = 1;
        Ray backward = forward;
        backward.origin = forward.origin + forward.direction;
        backward.direction = -forward.direction;
        const auto walk = [shape = c.shape()](Ray ray) {
            std::vector<Hit> hits;
            while (const auto hit = shape->hit(ray)) {
                hits.push_back(*hit);
                ray.t_min = hit->t;
            }
            return hits;
        };
        const std::vector<Hit> there = walk(forward), back = walk(backward);
        for (const auto* hits : {&there, &back})
            for (const Hit& h : *hits) {  // what lies at an end or on an edge, or is touched, rounding decides
                const double grazing = std::abs(dot(h.normal, normalize(c.ray.direction)));
                const bool planar = c.kind != Kind::sphere;
                const double inside =
                    std::min({h.u, h.v, c.kind == Kind::quad ? 1 - std::max(h.u, h.v) : 1 - h.u - h.v});
                RC_PRE(std::min({h.t, 1 - h.t, grazing}) > 1e-4 && (!planar || inside > 1e-4));
            }
        RC_ASSERT(there.size() == back.size());
        for (std::size_t i = 0; i < there.size(); ++i) {
            RC_ASSERT(std::abs(there[i].t - (1 - back[back.size() - 1 - i].t)) <= 1e-10);
            RC_ASSERT(nearly(Vec3(there[i].normal), Vec3(back[back.size() - 1 - i].normal)) || c.kind == Kind::sphere);
        }
        return !there.empty();
    });
}

TEST_CASE("Shapes: a narrower range that still holds the hit changes nothing, one that ends before it misses",
          "[shape][invariance]") {
    holds_for_hits([](const Case& c) {
        const auto shape = c.shape();
        const auto hit = shape->hit(c.ray);
        if (!hit) {
            Ray part = c.ray;
            part.t_min = draw_int(0, 8), part.t_max = part.t_min + draw_int(0, 8);
            RC_ASSERT(!shape->hit(part));
            return false;
        }
        Ray part = c.ray;
        part.t_max = hit->t;
        part.t_min = std::nextafter(hit->t, -kInfinity);
        const auto again = shape->hit(part);
        RC_ASSERT(same_to_the_bit(hit, again));
        RC_ASSERT(hit->normal == again->normal);
        part.t_min = 0, part.t_max = std::nextafter(hit->t, -kInfinity);
        RC_ASSERT((part.t_max < 0 || !shape->hit(part)));
        part.t_min = hit->t, part.t_max = kInfinity;
        const auto next = shape->hit(part);
        RC_ASSERT((!next || next->t > hit->t));
        RC_ASSERT((!next || c.kind == Kind::sphere));  // planar shapes are met once
        return true;
    });
}

TEST_CASE("Shapes: the box holds every hit but for its error bound, and touches the shape on all sides",
          "[shape][invariance]") {
    holds_for_hits([](const Case& c) {
        const auto shape = c.shape();
        const Box box = shape->bounds();
        Box tight;
        if (c.kind == Kind::sphere) {
            const Vec3 r{std::abs(c.radius), std::abs(c.radius), std::abs(c.radius)};
            tight = {c.p - r, c.p + r};
        } else {
            for (const Vec3& v : {Vec3{}, c.e, c.f}) tight.extend(c.p + v);
            if (c.kind == Kind::quad) tight.extend(c.p + c.e + c.f);
        }
        RC_ASSERT(box.contains(tight));
        RC_ASSERT(grow(tight, {1e-13, 1e-13, 1e-13}).contains(box));
        const auto hit = shape->hit(c.ray);
        if (!hit) return false;
        const Vec3 along_ray = gamma(4) * hit->t * limn::abs(c.ray.direction) + gamma(4) * Vec3{16, 16, 16};
        RC_ASSERT(grow(box, hit->position_error + along_ray).contains(c.ray.at(hit->t)));
        return true;
    });
}

TEST_CASE("Shapes: seen through the identity, and through steps of 2^k and whole numbers, they are hit alike",
          "[shape][invariance]") {
    holds_for_hits([](const Case& c) {
        const auto shape = c.shape();
        const auto hit = shape->hit(c.ray);
        const auto unmoved = Instance(shape, Transform{}).hit(c.ray);
        RC_ASSERT(same_but_for_rounding(hit, unmoved));
        if (hit) RC_ASSERT(nearly(Vec3(hit->normal), Vec3(unmoved->normal)));

        const auto factor = [] { return (draw_int(0, 1) ? -1 : 1) * draw_power_of_two(-3, 3); };
        const double x = factor(), y = factor(), z = factor();
        const Vec3 by = 64 * draw_vec(99);
        const Transform m = Transform::translate(by) * Transform::scale(x, y, z);
        Ray ray = c.ray;
        ray.origin = transform_point(m, c.ray.origin);
        ray.direction = transform_vector(m, c.ray.direction);
        const auto seen = Instance(shape, m).hit(ray);
        RC_ASSERT(same_but_for_rounding(hit, seen));
        if (!hit) return false;
        const Vec3 n{hit->normal.x / x, hit->normal.y / y, hit->normal.z / z};
        RC_ASSERT(nearly(normalize(n), Vec3(seen->normal)));
        // The bound covers the object's own, stretched, and the rounding in world space.
        for (std::size_t a = 0; a < 3; ++a)
            RC_ASSERT(seen->position_error[a] >= std::abs(m.rows[a][a]) * hit->position_error[a]);
        return true;
    });
}

}  // namespace limn::invariance_test
