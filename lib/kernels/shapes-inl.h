// The primitives of the flat scene as the filters have them. Per-target include guard, as Highway has it.
#if defined(LIMN_KERNELS_SHAPES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_KERNELS_SHAPES_INL_H
#undef LIMN_KERNELS_SHAPES_INL_H
#else
#define LIMN_KERNELS_SHAPES_INL_H
#endif

#include <array>
#include <bit>

#include "core/sphere_uv.h"
#include "flat/scene.h"
#include "predicates/quad-inl.h"
#include "predicates/sphere-inl.h"
#include "predicates/triangle-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::kernels::HWY_NAMESPACE {

using namespace limn::HWY_NAMESPACE;

// visit(shape) with a triangle, quad or sphere: its row of the table of its kind, of a mesh its triangle `element`.
// kKinds: those that there may be.
template <unsigned kKinds, class Visit>
HWY_INLINE bool with_shape(const flat::Scene& scene, PrimitiveKind kind, std::uint32_t row, std::uint32_t element,
                           double time, const Visit& visit) {
    constexpr auto has = [](PrimitiveKind k) { return (kKinds & flat::bit(k)) != 0; };
    if constexpr (has(PrimitiveKind::sphere))
        if (kind == PrimitiveKind::sphere) {
            const flat::Sphere& s = scene.spheres[row];
            return visit(sphere_of<double>(s.center, s.radius));
        }
    if constexpr (has(PrimitiveKind::moving_sphere))
        if (kind == PrimitiveKind::moving_sphere) {
            const flat::MovingSphere& s = scene.moving_spheres[row];
            return visit(sphere_of<double>(interpolate(s.center0, s.center1, time), s.radius));
        }
    if constexpr (has(PrimitiveKind::quad))
        if (kind == PrimitiveKind::quad) {
            const flat::Quad& q = scene.quads[row];
            return visit(quad_of<double>(q.corner, q.edge_u, q.edge_v));
        }
    if constexpr (has(PrimitiveKind::triangle))
        if (kind == PrimitiveKind::triangle) {
            const flat::Triangle& t = scene.triangles[row];
            return visit(triangle_of<double>(t.a, t.b, t.c));
        }
    if constexpr (has(PrimitiveKind::mesh))
        if (kind == PrimitiveKind::mesh) {
            const TriangleVertices v = flat::triangle_of(scene, scene.meshes[row], element);
            return visit(triangle_of<double>(v.a, v.b, v.c));
        }
    return false;
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
