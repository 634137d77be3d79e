#include "compile/list.h"

#include <algorithm>
#include <cmath>

#include "core/mesh_triangle.h"
#include "core/settle.h"

namespace limn::compiler {

namespace {

using flat::PrimitiveList;

// Rounding of instanced vertices, of the magnitudes that enter them: 4 products and sums, and slack.
constexpr double kInstanceError = 8 * kRoundoff;
// How thin a primitive may be, and how small beside the scene, for its weights to be worth computing in float.
constexpr double kThinnest = 0x1p-12, kSmallest = 0x1p-12;

double sum_abs(const Vec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

class Lister {
public:
    explicit Lister(flat::Scene& scene) : scene_(scene), root_(flat::group_at(scene, GroupId::root)) {}

    void run() {
        const bool is_in_range = root_.scale == 1 && root_.extent > 0x1p-20 && root_.extent < 0x1p39;
        if (!is_in_range || scene_.stored_primitives > PrimitiveList::kMost || !add_group(root_, 0, nullptr, 0)) return;
        if (entries_.empty() || entries_.size() > PrimitiveList::kMost) return;
        const auto rank = [](const PrimitiveList::Entry& e) {
            return e.kind == PrimitiveKind::quad ? 0 : e.kind == PrimitiveKind::sphere ? 2 : 1;
        };
        std::ranges::stable_sort(entries_, {}, rank);
        PrimitiveList list;
        for (const PrimitiveList::Entry& e : entries_)
            ++(rank(e) == 0 ? list.quads : rank(e) == 1 ? list.triangles : list.spheres);
        list.entries = std::move(entries_);
        if (pack(list)) scene_.list = std::move(list);
    }

private:
    // Whether all of the group can be listed.
    bool add_group(const flat::Group& group, std::uint64_t first_number, const Transform* matrix,
                   std::uint32_t instance) {
        for (std::uint32_t i = 0; i < group.range_count; ++i) {
            const PrimitiveRange& range = scene_.ranges[group.first_range + i];
            const std::uint64_t number = first_number + range.first_number;
            if (range.kind == PrimitiveKind::instance) {
                const flat::Instance& inner = scene_.instances[range.first_row];
                if (matrix || inner.moving) return false;
                if (!add_group(flat::group_at(scene_, inner.group), number, &inner.world_from_object0, range.first_row))
                    return false;
                continue;
            }
            if (range.kind == PrimitiveKind::medium) continue;  // apart
            for (std::uint64_t e = 0; e < range.count; ++e)
                if (!add(range, static_cast<std::uint32_t>(e), number + e, matrix, instance)) return false;
        }
        return true;
    }

    bool add(const PrimitiveRange& range, std::uint32_t element, std::uint64_t number, const Transform* matrix,
             std::uint32_t instance) {
        if (entries_.size() == PrimitiveList::kMost) return false;
        PrimitiveList::Entry e;
        e.kind = range.kind, e.number = number, e.row = range.first_row + element;
        e.is_instanced = matrix != nullptr, e.instance = instance;
        switch (range.kind) {
            case PrimitiveKind::quad: {
                const flat::Quad& q = scene_.quads[e.row];
                e.corner = q.corner, e.edge_u = q.edge_u, e.edge_v = q.edge_v;
                break;
            }
            case PrimitiveKind::triangle: {
                const flat::Triangle& t = scene_.triangles[e.row];
                if (are_collinear(t.a, t.b, t.c)) return true;
                e.corner = t.a, e.edge_u = t.b - t.a, e.edge_v = t.c - t.a;
                break;
            }
            case PrimitiveKind::mesh: {
                const TriangleVertices t = triangle_vertices(scene_.meshes[range.first_row].arrays, element);
                if (are_collinear(t.a, t.b, t.c)) return true;  // in no tree either
                e.row = range.first_row, e.element = element;
                e.corner = t.a, e.edge_u = t.b - t.a, e.edge_v = t.c - t.a;
                break;
            }
            case PrimitiveKind::sphere: {
                if (matrix) return false;
                const flat::Sphere& s = scene_.spheres[e.row];
                e.corner = s.center, e.radius = std::abs(s.radius);
                break;
            }
            case PrimitiveKind::moving_sphere:
            case PrimitiveKind::instance:
            case PrimitiveKind::foreign:
            case PrimitiveKind::medium: return false;
        }
        if (matrix) {
            const double size = max_abs(e.corner) + max_abs(e.edge_u) + max_abs(e.edge_v);
            for (const auto& m : matrix->rows) {
                const double most = sum_abs({m[0], m[1], m[2]}) * size + std::abs(m[3]);
                e.error = std::max(e.error, kInstanceError * most);
            }
            e.corner = transform_point(*matrix, e.corner);
            e.edge_u = transform_vector(*matrix, e.edge_u), e.edge_v = transform_vector(*matrix, e.edge_v);
        }
        entries_.push_back(e);
        return true;
    }

    bool pack(PrimitiveList& list) const {
        const auto padded = [](std::uint32_t n) {
            return (n + static_cast<std::uint32_t>(PrimitiveList::kAlign) - 1) / PrimitiveList::kAlign *
                   PrimitiveList::kAlign;
        };
        list.planar_stride = static_cast<std::uint32_t>(padded(list.planars()));
        list.sphere_stride = static_cast<std::uint32_t>(padded(list.spheres));
        list.planar.assign(PrimitiveList::kPlanarRows * list.planar_stride, 0);
        list.round.assign(PrimitiveList::kSphereRows * list.sphere_stride, 0);
        for (std::uint32_t i = 0; i < list.planars(); ++i)
            if (!pack_planar(list.entries[i], list, i)) return false;
        for (std::uint32_t i = 0; i < list.spheres; ++i) {
            const PrimitiveList::Entry& e = list.entries[list.planars() + i];
            if (!(e.radius > kSmallest * root_.extent)) return false;
            float* rows = list.round.data() + i;
            for (std::size_t a = 0; a < 3; ++a) rows[a * list.sphere_stride] = static_cast<float>(e.corner[a]);
            rows[PrimitiveList::kRadius * list.sphere_stride] = static_cast<float>(e.radius);
        }
        return true;
    }

    bool pack_planar(const PrimitiveList::Entry& e, PrimitiveList& list, std::uint32_t i) const {
        const Vec3 n = cross(e.edge_u, e.edge_v);
        const double size = max_abs(n), edges = max_abs(e.edge_u) * max_abs(e.edge_v);
        if (!(size > kThinnest * edges) || !(e.error < 0x1p-40 * root_.extent)) return false;
        const double squared = dot(n, n);
        const Vec3 normal = n / size, u = cross(e.edge_v, n) / squared, v = cross(n, e.edge_u) / squared;
        const double spread = std::max(sum_abs(u), sum_abs(v));
        if (!(spread * root_.extent < 1 / kSmallest)) return false;
        const Vec3 corner = e.corner - Point3{};
        const double offset = dot(normal, corner), u_offset = dot(u, corner), v_offset = dot(v, corner);
        const auto put = [&](std::size_t row, double x) {
            list.planar[row * list.planar_stride + i] = static_cast<float>(x);
        };
        for (std::size_t a = 0; a < 3; ++a) {
            put(PrimitiveList::kNormal + a, normal[a]);
            put(PrimitiveList::kU + a, u[a]), put(PrimitiveList::kV + a, v[a]);
        }
        put(PrimitiveList::kOffset, offset), put(PrimitiveList::kUOffset, u_offset);
        put(PrimitiveList::kVOffset, v_offset), put(PrimitiveList::kSpread, 2 * spread * (1 + 0x1p-20));
        return true;
    }

    flat::Scene& scene_;
    const flat::Group& root_;
    std::vector<PrimitiveList::Entry> entries_;
};

}  // namespace

void list_primitives(flat::Scene& scene) { Lister(scene).run(); }

}  // namespace limn::compiler
