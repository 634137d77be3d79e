// The exact question for the nearest hit of many rays, side by side. Per-target include guard, as Highway has it.
#if defined(LIMN_KERNELS_WINNERS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_KERNELS_WINNERS_INL_H
#undef LIMN_KERNELS_WINNERS_INL_H
#else
#define LIMN_KERNELS_WINNERS_INL_H
#endif

#include "kernels/exact_filters-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::kernels::HWY_NAMESPACE {

// Questions to planar primitives, collected and answered side by side.
template <std::size_t kLanes, std::size_t kMost>
class PlanarWinners {
public:
    using Doubles = hn::CappedTag<double, kLanes>;
    bool is_full() const { return size_ == kMost; }

    // The next question: a triangle's vertices or a quad's corner and edges. `tag` comes back with the answer.
    template <class A, class B>
    HWY_INLINE void add(const RayFrame& frame, const Search& search, const A& a, const B& b, const B& c,
                        std::uint32_t tag) {
        const std::size_t i = size_++;
        const Ray& ray = frame.ray;
        const PermutedAxes axes(ray.direction);
        for (std::size_t k = 0; k < 3; ++k) {
            const unsigned axis = axes.of[k];
            origin_[k][i] = coordinate(ray.origin, axis);
            direction_[k][i] = coordinate(ray.direction, axis);
            vertex_[k][i] = coordinate(a, axis);
            vertex_[3 + k][i] = coordinate(b, axis);
            vertex_[6 + k][i] = coordinate(c, axis);
        }
        origin_error_[i] = frame.origin_error, direction_error_[i] = frame.direction_error;
        t_min_[i] = search.t_min, t_max_[i] = search.t_max;
        tag_[i] = tag;
    }

    // answer(tag, decision, hit) for each in turn; unsure: not answered here. Empties the list.
    template <bool kQuad, class Answer>
    HWY_INLINE void settle(const Answer& answer) {
        const Doubles d;
        for (std::size_t i = 0; i < size_; i += hn::Lanes(d)) {
            HWY_ALIGN double t[kLanes], u[kLanes], v[kLanes];
            const auto answers = PlanarFilter<kQuad, Doubles>::answer(d, question(i));
            const std::uint32_t hits = bits(d, answers.hit), misses = bits(d, answers.miss);
            hn::Store(answers.t, d, t), hn::Store(answers.u, d, u), hn::Store(answers.v, d, v);
            for (std::size_t k = 0; k < std::min(hn::Lanes(d), size_ - i); ++k) {
                answer(tag_[i + k], decision(hits, misses, k), PlanarHit{t[k], u[k], v[k]});
            }
        }
        size_ = 0;
    }

private:
    HWY_INLINE PlanarQuestion<Doubles> question(std::size_t i) const {
        const Doubles d;
        PlanarQuestion<Doubles> q;
        for (std::size_t a = 0; a < 3; ++a)
            q.origin[a] = hn::Load(d, origin_[a] + i), q.direction[a] = hn::Load(d, direction_[a] + i);
        for (std::size_t k = 0; k < 9; ++k) q.vertex[k] = hn::Load(d, vertex_[k] + i);
        q.origin_error = hn::Load(d, origin_error_ + i), q.direction_error = hn::Load(d, direction_error_ + i);
        q.t_min = hn::Load(d, t_min_ + i), q.t_max = hn::Load(d, t_max_ + i);
        return q;
    }

    std::size_t size_ = 0;
    HWY_ALIGN double origin_[3][kMost], direction_[3][kMost], vertex_[9][kMost];
    HWY_ALIGN double origin_error_[kMost], direction_error_[kMost], t_min_[kMost], t_max_[kMost];
    std::uint32_t tag_[kMost];
};

// Questions to spheres, collected and answered side by side.
template <std::size_t kLanes, std::size_t kMost>
class SphereWinners {
public:
    using Doubles = hn::CappedTag<double, kLanes>;

    bool is_full() const { return size_ == kMost; }

    HWY_INLINE void add(const RayFrame& frame, const Search& search, const Point3& center, double radius,
                        std::uint32_t tag) {
        const std::size_t i = size_++;
        const Ray& ray = frame.ray;
        origin_[0][i] = ray.origin.x, origin_[1][i] = ray.origin.y, origin_[2][i] = ray.origin.z;
        direction_[0][i] = ray.direction.x, direction_[1][i] = ray.direction.y, direction_[2][i] = ray.direction.z;
        center_[0][i] = center.x, center_[1][i] = center.y, center_[2][i] = center.z;
        radius_[i] = radius;
        origin_error_[i] = frame.origin_error, direction_error_[i] = frame.direction_error;
        t_min_[i] = search.t_min, t_max_[i] = search.t_max;
        tag_[i] = tag;
    }

    template <class Answer>
    HWY_INLINE void settle(const Answer& answer) {
        const Doubles d;
        for (std::size_t i = 0; i < size_; i += hn::Lanes(d)) {
            HWY_ALIGN double t[kLanes];
            const auto answers = filter_spheres(d, question(i));
            const std::uint32_t hits = bits(d, answers.hit), misses = bits(d, answers.miss);
            hn::Store(answers.t, d, t);
            for (std::size_t k = 0; k < std::min(hn::Lanes(d), size_ - i); ++k) {
                answer(tag_[i + k], decision(hits, misses, k), PlanarHit{t[k], 0, 0});
            }
        }
        size_ = 0;
    }

private:
    HWY_INLINE SphereQuestion<Doubles> question(std::size_t i) const {
        const auto load = [&](const double* row) HWY_ATTR { return hn::Load(Doubles(), row + i); };
        SphereQuestion<Doubles> q;
        for (std::size_t a = 0; a < 3; ++a)
            q.origin[a] = load(origin_[a]), q.direction[a] = load(direction_[a]), q.center[a] = load(center_[a]);
        q.radius = load(radius_), q.origin_error = load(origin_error_), q.direction_error = load(direction_error_);
        q.t_min = load(t_min_), q.t_max = load(t_max_);
        return q;
    }

    std::size_t size_ = 0;
    HWY_ALIGN double origin_[3][kMost], direction_[3][kMost], center_[3][kMost], radius_[kMost];
    HWY_ALIGN double origin_error_[kMost], direction_error_[kMost], t_min_[kMost], t_max_[kMost];
    std::uint32_t tag_[kMost];
};

using ManyWinners = PlanarWinners<8, 64>;
using ManySphereWinners = SphereWinners<8, 64>;

}  // namespace limn::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
