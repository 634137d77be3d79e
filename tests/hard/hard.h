// What the hard cases share: how many rays, one shape in both worlds, and the verdict on an answer.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "catch.h"
#include "limn/query/compiled_scene.h"
#include "limn/scene/shape/hittable_list.h"
#include "support/exact_truth.h"
#include "support/tally.h"

namespace limn::test {

/// Of a case's full number of rays: all of them where LIMN_FULL is set, a tenth where LIMN_ACCURACY is, else a
/// hundredth.
inline int count(double full) {
    const double share = std::getenv("LIMN_FULL") ? 1 : std::getenv("LIMN_ACCURACY") ? 10 : 100;
    return std::max(1, static_cast<int>(full / share));
}

inline std::string number(double x, int digits = 6) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*g", digits, x);
    return text;
}

/// The verdict over all rays of a row, each of them judged.
inline void check(const Tally& tally, const std::string& row) {
    INFO(row << ": " << tally.wrong << " of " << tally.rays << " wrong, first " << tally.first);
    CHECK(tally.wrong == 0);
    CHECK(tally.judged == tally.rays);
    CHECK(tally.rays > 0);
}

struct Answer {
    double t = kInfinity, u = 0, v = 0;
    std::uint64_t element = 0;
};

/// One object as it is described and as it is compiled, alone and in company (whose boxes its BVH has to tell apart).
class BothWorlds {
public:
    explicit BothWorlds(std::shared_ptr<const Hittable> object,
                        const std::vector<std::shared_ptr<const Hittable>>& company = {})
        : object_(std::move(object)), alone_(compiled({object_})) {
        if (company.empty()) return;
        std::vector<std::shared_ptr<const Hittable>> all{object_};
        all.insert(all.end(), company.begin(), company.end());
        list_ = std::make_unique<HittableList>(all);
        crowd_ = std::make_unique<CompiledScene>(compiled(all));
    }

    /// The object's nearest hit. A fault is counted where the worlds do not answer with the same bits.
    std::optional<Answer> hit(const Ray& ray, Tally& tally) const {
        const std::optional<Hit> described = object_->hit(ray);
        if (!same(described, alone_.closest_hit(ray)) || alone_.any_hit(ray) != described.has_value())
            tally.fault(ray, "the worlds differ");
        if (list_ &&
            (!same(list_->hit(ray), crowd_->closest_hit(ray)) || crowd_->any_hit(ray) != list_->hit(ray).has_value()))
            tally.fault(ray, "the worlds differ in company");
        if (!described) return std::nullopt;
        return Answer{described->t, described->u, described->v, described->element};
    }

private:
    static CompiledScene compiled(const std::vector<std::shared_ptr<const Hittable>>& objects) {
        Scene scene;
        for (const auto& object : objects) scene.add(object);
        return compile(scene);
    }
    // A sphere's u and v wait for its surface_at.
    static bool same(const std::optional<Hit>& a, const std::optional<RayHit>& b) {
        if (!a || !b) return !a && !b;
        return a->t == b->t && a->element == b->primitive &&
               ((b->u == 0 && b->v == 0) || (a->u == b->u && a->v == b->v));
    }

    std::shared_ptr<const Hittable> object_;
    CompiledScene alone_;
    std::unique_ptr<const HittableList> list_;
    std::unique_ptr<const CompiledScene> crowd_;
};

/// What an answer may be off by: float ulps of t, and an absolute error of u and v (negative: not compared).
struct Allowed {
    double t_ulps = 1;
    double uv = 0x1p-23;
};

namespace detail {

using ExactQuery = std::function<ExactHit(const Ray&)>;
using LimnQuery = std::function<std::optional<Answer>(const Ray&)>;

inline const Real kLargest = std::numeric_limits<double>::max();

// Beside an end of the interval, closer than t may be off, the reported t decides whether it is inside. Returns the
// truth by that rule: asks for hits with the interval a little wider, and what limn reports for them.
inline ExactHit truth_at_ends(const Ray& ray, const ExactQuery& exact, const LimnQuery& limn) {
    const auto beside = [](double t, double sign) { return t + sign * 0x1p-22 * std::max(std::abs(t), 0x1p-1050); };
    Ray of_truth = ray;
    of_truth.t_min = beside(ray.t_min, -1), of_truth.t_max = beside(ray.t_max, 1);
    Ray of_limn = of_truth;
    for (int root = 0; root < 2; ++root) {
        const ExactHit truth = exact(of_truth);
        const std::optional<Answer> reported = limn(of_limn);
        if (!reported && truth.hit && absolute(truth.t) > Real(1 - 0x1p-22) * kLargest) return {};  // to infinity
        if (root > 0 && !reported && truth.t <= Real(beside(ray.t_min, 1))) return {};  // one with the root before
        if (!reported || !truth.hit) return truth;
        if (reported->t > ray.t_max) return {};
        if (reported->t > ray.t_min) return truth;
        of_limn.t_min = reported->t, of_truth.t_min = static_cast<double>(truth.t);
        // Beyond this root, whose t may be rounded twice: -1 + 2^-1022 is -1 as a Real, too.
        if (const ExactHit same = exact(of_truth); same.hit && same.t <= truth.t)
            of_truth.t_min = std::nextafter(of_truth.t_min, kInfinity);
    }
    return {};
}

inline std::string fault_of(const ExactHit& truth, const std::optional<Answer>& answer, const Allowed& allowed) {
    if (truth.hit != answer.has_value()) return truth.hit ? "missed" : "false hit";
    if (!truth.hit) return {};
    const auto off = [](double reported, Real exact, Real bound) {
        return !std::isfinite(reported) || absolute(Real(reported) - exact) > bound;
    };
    if (off(answer->t, truth.t, Real(allowed.t_ulps * 0x1p-23) * absolute(truth.t) + Real(0x1p-1074)))
        return "t " + number(answer->t, 17) + " instead of " + number(static_cast<double>(truth.t), 17);
    if (allowed.uv < 0) return {};
    if (off(answer->u, truth.u, Real(allowed.uv)) || off(answer->v, truth.v, Real(allowed.uv))) return "u, v";
    return {};
}

}  // namespace detail

/// Judges limn's answer to one ray by the exact one. A hit whose t is beyond the largest double is none.
inline void judge(Tally& tally, const Ray& ray, const detail::ExactQuery& exact_query, const detail::LimnQuery& limn,
                  const Allowed& allowed = {}) {
    ++tally.rays, ++tally.judged;
    const auto exact = [&](const Ray& r) {
        const ExactHit truth = exact_query(r);
        return absolute(truth.t) > Real(1 + 0x1p-22) * detail::kLargest ? ExactHit{} : truth;
    };
    const std::optional<Answer> answer = limn(ray);
    if (answer) ++tally.hits;
    if (answer && !(answer->t > ray.t_min && answer->t <= ray.t_max)) tally.fault(ray, "outside of the interval");
    std::string fault = detail::fault_of(exact(ray), answer, allowed);
    if (!fault.empty()) fault = detail::fault_of(detail::truth_at_ends(ray, exact, limn), answer, allowed);
    if (!fault.empty()) tally.fault(ray, fault);
}

using Chain = std::span<const Transform>;

/// A shape that `world` holds, through the instances of `chain`.
///@{
inline void judge_sphere(Tally& tally, const BothWorlds& world, const Point3& center, double radius, const Ray& ray,
                         double t_ulps = 1, Chain chain = {}) {
    judge(
        tally, ray, [&](const Ray& r) { return exact_sphere_hit(center, radius, r, chain); },
        [&](const Ray& r) { return world.hit(r, tally); }, {t_ulps, -1});
}
inline void judge_triangle(Tally& tally, const BothWorlds& world, const std::array<Point3, 3>& corners, const Ray& ray,
                           Chain chain = {}) {
    judge(
        tally, ray, [&](const Ray& r) { return exact_triangle_hit(corners[0], corners[1], corners[2], r, chain); },
        [&](const Ray& r) { return world.hit(r, tally); });
}
inline void judge_quad(Tally& tally, const BothWorlds& world, const Point3& corner, const Vec3& edge_u,
                       const Vec3& edge_v, const Ray& ray, Chain chain = {}) {
    judge(
        tally, ray, [&](const Ray& r) { return exact_quad_hit(corner, edge_u, edge_v, r, chain); },
        [&](const Ray& r) { return world.hit(r, tally); });
}
///@}

}  // namespace limn::test
