// The primitives of the flat scene as the filters have them. Per-target include guard, as Highway has it.
#if defined(LIMN_KERNELS_SHAPES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_KERNELS_SHAPES_INL_H
#undef LIMN_KERNELS_SHAPES_INL_H
#else
#define LIMN_KERNELS_SHAPES_INL_H
#endif

#include <array>
#include <bit>
#include <functional>

#include "core/sphere_uv.h"
#include "flat/scene.h"
#include "predicates/quad-inl.h"
#include "predicates/sphere-inl.h"
#include "predicates/triangle-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::kernels::HWY_NAMESPACE {

using namespace limn::HWY_NAMESPACE;

// The predicates of rows.
HWY_INLINE auto shape_of(const primitives::Sphere& s, double) { return sphere_of<double>(s.center, s.radius); }
HWY_INLINE auto shape_of(const primitives::MovingSphere& s, double time) { return shape_of(s.at(time), time); }
HWY_INLINE auto shape_of(const primitives::Quad& q, double) { return quad_of<double>(q.corner, q.edge_u, q.edge_v); }
HWY_INLINE auto shape_of(const primitives::Triangle& t, double) { return triangle_of<double>(t.a, t.b, t.c); }

// Others know for themselves.
template <class Kind>
HWY_INLINE auto shape_of(const Kind& row, double) {
    return std::cref(row);
}

template <unsigned kKinds, class Kind, class Visit>
HWY_INLINE bool visit_row(const std::vector<Kind>& rows, PrimitiveKind kind, std::uint32_t row, double time,
                          const Visit& visit) {
    if constexpr ((kKinds & flat::bit(Kind::kKind)) != 0)
        if (kind == Kind::kKind) return visit(shape_of(rows[row], time));
    return false;
}
template <unsigned kKinds, class Visit, class... Kind>
HWY_INLINE bool visit_row(const std::tuple<std::vector<Kind>...>& tables, PrimitiveKind kind, std::uint32_t row,
                          double time, const Visit& visit) {
    return (visit_row<kKinds>(std::get<std::vector<Kind>>(tables), kind, row, time, visit) || ...);
}

// visit(shape) with the predicate of a row of the table of its kind, or of triangle `element` of a mesh. kKinds: those
// that there may be.
template <unsigned kKinds, class Visit>
HWY_INLINE bool with_shape(const flat::Scene& scene, PrimitiveKind kind, std::uint32_t row, std::uint32_t element,
                           double time, const Visit& visit) {
    if constexpr ((kKinds & flat::bit(PrimitiveKind::mesh)) != 0)
        if (kind == PrimitiveKind::mesh) {
            const TriangleVertices v = flat::triangle_of(scene, scene.meshes[row], element);
            return visit(triangle_of<double>(v.a, v.b, v.c));
        }
    return visit_row<kKinds>(scene.rows, kind, row, time, visit);
}

// Shapes of one kind and rays that may hit them, one by one, to be tested in lanes.
template <template <class> class Predicate>
class ExactQueue {
public:
    ExactQueue() : size_(0) {}  // the rest is left as it is

    bool is_full() const { return size_ == kSize; }

    // `tag` comes back with the answer.
    HWY_INLINE void add(const Predicate<double>& shape, const RayFrame& frame, const Search& search,
                        std::uint32_t tag) {
        const double of_ray[kRay] = {frame.ray.origin.x,    frame.ray.origin.y,    frame.ray.origin.z,
                                     frame.ray.direction.x, frame.ray.direction.y, frame.ray.direction.z,
                                     frame.origin_error,    frame.direction_error, search.t_min,
                                     search.t_max};
        for (std::size_t k = 0; k < kRay; ++k) ray_[k][size_] = of_ray[k];
        for (std::size_t k = 0; k < Predicate<double>::kNumbers; ++k) shape_[k][size_] = number_of<double>(shape, k);
        tag_[size_++] = tag;
    }

    // report(tag, hit) for each hit and intersect(tag) for each that stays undecided. Empties the queue.
    template <class Report, class Intersect>
    HWY_INLINE void flush(const Report& report, const Intersect& intersect) {
        constexpr std::size_t kWidth = kLanes<Doubles>;
        for (std::size_t i = size_; i % kWidth != 0; ++i) {  // what fills the last lanes
            for (auto& row : ray_) row[i] = row[size_ - 1];
            for (auto& row : shape_) row[i] = row[size_ - 1];
        }
        for (std::size_t i = 0; i < size_; i += kWidth) {
            const auto of_ray = [&](std::size_t k) HWY_ATTR { return load<Doubles>(ray_[k] + i); };
            const auto of_shape = [&](std::size_t k) HWY_ATTR { return load<Doubles>(shape_[k] + i); };
            const RayOf<Doubles> ray{three<Doubles>(of_ray, 0), three<Doubles>(of_ray, 3), of_ray(6), of_ray(7)};
            const auto shape = Predicate<Doubles>::from(of_shape);
            const FilterResult<Doubles> r = shape.filter(typename Predicate<Doubles>::Ray(ray), {of_ray(8), of_ray(9)});
            HWY_ALIGN double t[kWidth], u[kWidth], v[kWidth];
            store(r.t, t), store(r.u, u), store(r.v, v);
            const std::uint32_t hits = bits(r.hit), misses = bits(r.miss);
            for (std::size_t k = 0; k < kWidth && i + k < size_; ++k) {
                if ((hits >> k & 1) != 0)
                    report(tag_[i + k], PlanarHit{t[k], u[k], v[k]});
                else if ((misses >> k & 1) == 0)
                    intersect(tag_[i + k]);
            }
        }
        size_ = 0;
    }

private:
    static constexpr std::size_t kSize = 64, kRay = 10;

    std::size_t size_;
    HWY_ALIGN double ray_[kRay][kSize], shape_[Predicate<double>::kNumbers][kSize];
    std::uint32_t tag_[kSize];
};

}  // namespace limn::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
