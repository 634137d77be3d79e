#include "kernels/traverse.h"

#include <utility>

#include "accel/binary_bvh.h"
#include "accel/slab.h"
#include "core/intersect_quad.h"
#include "core/intersect_sphere.h"
#include "core/intersect_triangle.h"
#include "core/mesh_triangle.h"
#include "core/sphere_uv.h"

namespace limn::kernels {

namespace {

// What to do with hits. `limit` is the t beyond which nothing matters; `report` returns true to end the search.
struct Closest {
    static constexpr bool kEveryHit = false, kThroughBoundaries = false;
    flat::RawHit best;

    double limit() const { return best.t; }
    bool report(double t, std::uint64_t number, bool /*inward*/) {
        if (t < best.t || number < best.primitive) best = {t, number};
        return false;
    }
};

template <bool kThrough>
struct Any {
    static constexpr bool kEveryHit = false, kThroughBoundaries = kThrough;
    double t_max;
    bool found = false;

    double limit() const { return t_max; }
    bool report(double, std::uint64_t, bool) { return found = true; }
};

struct Every {
    static constexpr bool kEveryHit = true, kThroughBoundaries = false;
    double t_max;
    std::vector<Crossing>& crossings;

    double limit() const { return t_max; }
    bool report(double t, std::uint64_t, bool inward) {
        crossings.push_back({t, inward});
        return false;
    }
};

// One ray through one group. kKinds: the primitive kinds that the scene has; code for the others is left out.
template <unsigned kKinds, class Query>
class Traversal {
public:
    // `frame` and `query` are kept by reference.
    Traversal(const flat::Scene& scene, const flat::Group& group, const RayFrame& frame, std::uint64_t first_number,
              Query& query)
        : scene_(scene),
          group_(group),
          frame_(frame),
          ray_(frame.ray),
          slab_(frame.ray, group.extent, frame.origin_error, frame.direction_error),
          sheared_(frame, group.extent),
          sphere_ray_(frame),
          first_number_(first_number),
          query_(query) {}

    // True if the query ended the search.
    bool run() {
        struct Entry {
            double near;
            std::uint32_t child, count;
        } stack[accel::kMaxDepth + 2];
        int size = 0;
        std::uint32_t node_row = group_.root;
        for (;;) {
            const flat::Node& node = scene_.nodes[node_row];
            double near[2];
            const bool met[2] = {slab_.meets(node.lower[0], node.upper[0], query_.limit(), near[0]),
                                 slab_.meets(node.lower[1], node.upper[1], query_.limit(), near[1])};
            const int first = met[0] && met[1] ? near[1] < near[0] : met[1];
            if (met[1 - first]) stack[size++] = {near[1 - first], node.child[1 - first], node.count[1 - first]};
            if (met[first]) stack[size++] = {near[first], node.child[first], node.count[first]};
            for (;;) {
                if (size == 0) return false;
                const Entry entry = stack[--size];
                if (slab_.is_beyond(entry.near, query_.limit())) continue;
                if (entry.count == 0) {
                    node_row = entry.child;
                    break;
                }
                for (std::uint32_t i = 0; i < entry.count; ++i)
                    if (test(scene_.references[entry.child + i])) return true;
            }
        }
    }

private:
    static constexpr bool has(PrimitiveKind kind) { return (kKinds & flat::bit(kind)) != 0; }

    bool test(const flat::Reference& reference) {
        const PrimitiveRange& range = scene_.ranges[reference.range];
        const std::uint64_t number = first_number_ + range.first_number + reference.element;
        const std::uint32_t row = range.first_row + reference.element;
        switch (range.kind) {
            case PrimitiveKind::sphere:
                if constexpr (has(PrimitiveKind::sphere)) {
                    const flat::Sphere& s = scene_.spheres[row];
                    return sphere(s.center, s.radius, number);
                }
                break;
            case PrimitiveKind::moving_sphere:
                if constexpr (has(PrimitiveKind::moving_sphere)) {
                    const flat::MovingSphere& s = scene_.moving_spheres[row];
                    return sphere(interpolate(s.center0, s.center1, ray_.time), s.radius, number);
                }
                break;
            case PrimitiveKind::triangle:
                if constexpr (has(PrimitiveKind::triangle)) {
                    const flat::Triangle& t = scene_.triangles[row];
                    return triangle(t.a, t.b, t.c, number);
                }
                break;
            case PrimitiveKind::mesh:
                if constexpr (has(PrimitiveKind::mesh)) {
                    const TriangleVertices v =
                        triangle_vertices(scene_.meshes[range.first_row].arrays, reference.element);
                    return triangle(v.a, v.b, v.c, number);
                }
                break;
            case PrimitiveKind::quad:
                if constexpr (has(PrimitiveKind::quad)) {
                    const flat::Quad& q = scene_.quads[row];
                    PlanarHit hit;
                    return intersect_quad(q.corner, q.edge_u, q.edge_v, sheared_, search(), hit) &&
                           query_.report(hit.t, number, inward(cross(q.edge_u, q.edge_v)));
                }
                break;
            case PrimitiveKind::instance:
                if constexpr (has(PrimitiveKind::instance)) {
                    const flat::Instance& instance = scene_.instances[range.first_row];
                    const flat::Group& group = flat::group_at(scene_, instance.group);
                    return inside(instance, frame_, [&](const RayFrame& frame) {
                        return is_usable(frame.ray) && Traversal(scene_, group, frame, number, query_).run();
                    });
                }
                break;
            case PrimitiveKind::foreign:
                if constexpr (has(PrimitiveKind::foreign)) return foreign(scene_.foreign[row], number);
                break;
            case PrimitiveKind::medium: break;  // never in a tree
        }
        return false;
    }

    bool inward(const Vec3& outward) const { return Query::kEveryHit && dot(outward, ray_.direction) < 0; }

    Search search() const { return {ray_.t_min, query_.limit()}; }

    bool sphere(const Point3& center, double radius, std::uint64_t number) {
        if constexpr (Query::kEveryHit) {
            const SphereHits hits = intersect_sphere(center, std::abs(radius), sphere_ray_, search(), true);
            return (hits.near_found && query_.report(hits.near, number, radius > 0)) ||
                   (hits.far_found && query_.report(hits.far, number, radius < 0));
        } else {
            double t = 0;
            return intersect_sphere(center, std::abs(radius), sphere_ray_, search(), t) &&
                   query_.report(t, number, false);
        }
    }

    bool triangle(const Point3& a, const Point3& b, const Point3& c, std::uint64_t number) {
        PlanarHit hit;
        return intersect_triangle(a, b, c, sheared_, search(), hit) &&
               query_.report(hit.t, number, Query::kEveryHit && inward(cross(b - a, c - a)));
    }

    bool foreign(const flat::Foreign& shape, std::uint64_t number) {
        const FrameScope scope(frame_);  // it may consist of limn's own shapes
        Ray rest = ray_;
        rest.t_max = query_.limit();
        ForeignHit hit;
        while (shape.hit(*shape.object, rest, hit)) {
            if (!(hit.t > rest.t_min && hit.t <= rest.t_max)) return false;  // not what hit() promises: a miss
            const bool passes = Query::kThroughBoundaries && hit.index_matched;
            if (!passes && query_.report(hit.t, number, inward(Vec3(hit.normal)))) return true;
            if (!passes && !Query::kEveryHit) return false;
            rest.t_min = hit.t;
        }
        return false;
    }

    const flat::Scene& scene_;
    const flat::Group& group_;
    const RayFrame& frame_;
    const Ray& ray_;
    const accel::SlabRay slab_;
    const ShearedRay sheared_;
    const SphereRay sphere_ray_;
    const std::uint64_t first_number_;
    Query& query_;
};

template <class... Kinds>
constexpr unsigned kinds(Kinds... kind) {
    return (flat::bit(kind) | ...);
}

// The sets of kinds that have code of their own. Simple scenes do not pay for what only others need.
constexpr unsigned kMeshes = kinds(PrimitiveKind::mesh);
constexpr unsigned kSpheres = kinds(PrimitiveKind::sphere, PrimitiveKind::moving_sphere);
constexpr unsigned kStill =
    kinds(PrimitiveKind::sphere, PrimitiveKind::triangle, PrimitiveKind::quad, PrimitiveKind::mesh);
constexpr unsigned kAll = ~0u;

template <class Query>
void search(const flat::Scene& scene, GroupId id, const RayFrame& frame, std::uint64_t first_number, Query& query) {
    const flat::Group& group = flat::group_at(scene, id);
    const auto run = [&]<unsigned kKinds>(std::integral_constant<unsigned, kKinds>) {
        Traversal<kKinds, Query>(scene, group, frame, first_number, query).run();
    };
    const auto covers = [&](unsigned set) { return (scene.kinds & ~set) == 0; };
    if (covers(kMeshes)) return run(std::integral_constant<unsigned, kMeshes>{});
    if (covers(kSpheres)) return run(std::integral_constant<unsigned, kSpheres>{});
    if (covers(kStill)) return run(std::integral_constant<unsigned, kStill>{});
    run(std::integral_constant<unsigned, kAll>{});
}

flat::RawHit nearest(const flat::Scene& scene, GroupId id, const RayFrame& frame, std::uint64_t first_number) {
    Closest query{{frame.ray.t_max, flat::RawHit::kMiss}};
    search(scene, id, frame, first_number, query);
    return query.best.primitive == flat::RawHit::kMiss ? flat::RawHit{} : query.best;
}

// visit(frame) with the ray as a medium's boundary sees it, `level` instances below the scene, unless nothing can be
// hit.
template <class Visit>
void inside_medium(const flat::Scene& scene, const flat::Medium& medium, const RayFrame& frame, const Visit& visit,
                   std::uint32_t level = 0) {
    if (level < medium.instance_count) {
        const std::uint32_t instance = scene.medium_instances[medium.first_instance + level];
        return inside(scene.instances[instance], frame,
                      [&](const RayFrame& inner) { inside_medium(scene, medium, inner, visit, level + 1); });
    }
    if (is_usable(frame.ray)) visit(frame);
}

GroupId boundary_of(const flat::Scene& scene, const flat::Medium& medium) {
    return scene.medium_shapes[medium.shape].boundary;
}

bool meets_bounds(const flat::Medium& medium, const Ray& ray) {
    double near = 0;
    return accel::SlabRay(ray, accel::finite_extent(medium.bounds)).meets(medium.bounds, ray.t_max, near);
}

}  // namespace

flat::RawHit closest_hit(const flat::Scene& scene, const Ray& ray) {
    return nearest(scene, GroupId::root, RayFrame(ray), 0);
}

bool any_hit(const flat::Scene& scene, const Ray& ray) {
    Any<false> query{ray.t_max};
    search(scene, GroupId::root, RayFrame(ray), 0, query);
    return query.found;
}

bool is_occluded(const flat::Scene& scene, const Ray& ray) {
    Any<true> query{ray.t_max};
    search(scene, GroupId::root, RayFrame(ray), 0, query);
    return query.found;
}

flat::RawHit closest_boundary(const flat::Scene& scene, const flat::Medium& medium, const Ray& ray) {
    flat::RawHit hit;
    if (!meets_bounds(medium, ray)) return hit;
    inside_medium(scene, medium, RayFrame(ray), [&](const RayFrame& frame) {
        hit = nearest(scene, boundary_of(scene, medium), frame, medium.first_number);
    });
    return hit;
}

void crossings(const flat::Scene& scene, const flat::Medium& medium, const Ray& ray, std::vector<Crossing>& out) {
    out.clear();
    if (!meets_bounds(medium, ray)) return;
    inside_medium(scene, medium, RayFrame(ray), [&](const RayFrame& frame) {
        Every query{ray.t_max, out};
        search(scene, boundary_of(scene, medium), frame, medium.first_number, query);
    });
}

}  // namespace limn::kernels
