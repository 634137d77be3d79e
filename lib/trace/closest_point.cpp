#include "trace/closest_point.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "limn/math/error.h"
#include "math/scaled_matrix.h"

namespace limn::trace {

namespace {

// Bounds on rounding errors: kLess is the factor for a squared distance to a box, 1 less 2^-40. kSlack is the error of
// the coordinates of a transformed box.
constexpr double kLess = 1 - 0x1p-40, kSlack = 0x1p-45;

Transform placed(const flat::Instance& instance, const Transform* outer, double time) {
    const Transform m = flat::world_from_object(instance, time);
    return outer != nullptr ? *outer * m : m;
}

// Returns the factor by which a matrix scales lengths. \throws ArgumentError if it isn't the same in all directions
double similarity_of(const Transform& m) {
    const ScaledMatrix scaled(m);
    const auto& rows = scaled.matrix.rows;
    Vec3 columns[3];
    for (std::size_t c = 0; c < 3; ++c) columns[c] = {rows[0][c], rows[1][c], rows[2][c]};
    const double square = length_squared(columns[0]);
    for (std::size_t c = 0; c < 3; ++c) {
        const bool is_right = std::abs(dot(columns[c], columns[(c + 1) % 3])) <= 0x1p-40 * square;
        if (!is_right || !(std::abs(length_squared(columns[c]) - square) <= 0x1p-40 * square))
            throw ArgumentError("closest_point: a round shape stands in an instance that does not leave it round");
    }
    return std::ldexp(std::sqrt(square), scaled.exponent);
}

// Maps the space of a BLAS to one in which the query point is the origin and the coordinates of the world are at
// most 1.
struct Seen {
    Vec3 origin;         // the query point, times `unit`
    const Transform* m;  // the matrix from the BLAS to the world, or null for the world itself
    double unit;         // factor of world coordinates

    Vec3 point(const Point3& p) const {
        const Point3 q = m != nullptr ? transform_point(*m, p) : p;
        return unit * (q - Point3{}) - origin;
    }
    Vec3 vector(const Vec3& v) const { return unit * (m != nullptr ? transform_vector(*m, v) : v); }
    double size() const { return m != nullptr ? unit * similarity_of(*m) : unit; }

    // Returns a lower bound on the square of the distance of a box.
    double to_box(const double* lower, const double* upper) const {
        double sum = 0;
        if (m == nullptr) {
            for (std::size_t a = 0; a < 3; ++a) {
                const double outside = std::max({unit * lower[a] - origin[a], origin[a] - unit * upper[a], 0.0});
                sum += outside * outside;
            }
            return kLess * sum;
        }
        for (std::size_t a = 0; a < 3; ++a) {
            const auto& row = m->rows[a];
            double center = row[3], half = 0, size = std::abs(row[3]);
            for (std::size_t k = 0; k < 3; ++k) {
                const double middle = 0.5 * lower[k] + 0.5 * upper[k];
                center += row[k] * middle, size += std::abs(row[k] * middle);
                half += std::abs(row[k]) * (0.5 * upper[k] - 0.5 * lower[k]);
            }
            const double outside = std::abs(unit * center - origin[a]) - unit * (half + kSlack * (size + half));
            if (outside > 0) sum += outside * outside;
        }
        return kLess * sum;
    }
};

class Walk {
public:
    Walk(const flat::Scene& scene, const Point3& point, double max_distance, double time)
        : scene_(scene), time_(time), max_distance_(max_distance) {
        const double size = std::max(max_abs(point - Point3{}), flat::blas_at(scene, BlasId::root).extent);
        unit_ = std::ldexp(1.0, std::clamp(-std::ilogb(std::max(size, 0x1p-900)), -1000, 900));
        origin_ = unit_ * (point - Point3{});
        const double limit = unit_ * max_distance;
        best_squared_ = limit * limit * (1 + 0x1p-50);
    }

    void visit(BlasId id, const Transform* m, std::uint64_t first_number) {
        const flat::Blas& blas = flat::blas_at(scene_, id);
        if (blas.root == flat::kNothing) return;
        const Seen seen{origin_, m, unit_};
        std::array<Entry, flat::kMaxStack> stack;
        stack[0] = {0, blas.root};
        for (std::size_t size = 1; size > 0;) {
            const Entry entry = stack[--size];
            if (entry.squared > best_squared_) continue;
            if ((entry.child & flat::kLeaf) != 0)
                visit_leaf(entry.child, blas, seen, first_number);
            else
                push_children(scene_.nodes[entry.child], blas, seen, stack.data(), size);
        }
    }

    void visit_list() {
        for (const flat::PrimitiveList::Entry& e : scene_.list.entries) {
            if (!e.is_instanced) {
                visit_row({origin_, nullptr, unit_}, e.kind, e.row, e.element, e.number);
                continue;
            }
            const Transform m = placed(scene_.instances[e.instance], nullptr, time_);
            visit_row({origin_, &m, unit_}, e.kind, e.row, e.element, e.number);
        }
    }

    void visit_medium(const flat::Medium& medium, const Transform* m, std::uint32_t level) {
        if (level == medium.instance_count)
            return visit(scene_.medium_shapes[medium.shape].boundary, m, medium.first_number);
        const Transform inner =
            placed(scene_.instances[scene_.medium_instances[medium.first_instance + level]], m, time_);
        visit_medium(medium, &inner, level + 1);
    }

    NearestSurface nearest() const {
        NearestSurface found = best_;
        if (found.primitive == flat::RawHit::kMiss) return found;
        found.distance = length(best_.point.at) / unit_;
        if (found.distance > max_distance_) return {};  // its square was within the slack
        found.position = Point3{} + (1 / unit_) * (origin_ + best_.point.at);
        return found;
    }

private:
    struct Entry {
        double squared;
        flat::Child child;
    };

    void push_children(const flat::Node& node, const flat::Blas& blas, const Seen& seen, Entry* stack,
                       std::size_t& size) const {
        const std::size_t first = size;
        const double unscale = 1 / blas.scale;
        for (std::size_t slot = 0; slot < flat::kWidth && node.child[slot] != flat::kNothing; ++slot) {
            const double squared = to_box(seen, unscale, [&](std::size_t p) { return node.planes[p][slot]; });
            if (squared > best_squared_) continue;
            std::size_t at = size++;
            for (; at > first && stack[at - 1].squared < squared; --at) stack[at] = stack[at - 1];
            stack[at] = {squared, node.child[slot]};
        }
    }

    template <class Plane>
    static double to_box(const Seen& seen, double unscale, const Plane& plane) {
        double lower[3], upper[3];
        for (std::size_t a = 0; a < 3; ++a) {
            lower[a] = unscale * static_cast<double>(plane(a));
            upper[a] = unscale * static_cast<double>(plane(3 + a));
        }
        return seen.to_box(lower, upper);
    }

    void visit_leaf(flat::Child leaf, const flat::Blas& blas, const Seen& seen, std::uint64_t first_number) {
        const flat::BlockView block(&scene_.lines[leaf & flat::kPlaceMask]);
        const flat::Form form = flat::form_of(leaf);
        for (std::size_t lane = 0; lane < block.count(form); ++lane) {
            const std::uint32_t id = block.id(form, lane);
            if ((id & flat::kReference) != 0)
                visit_reference(scene_.references[id & ~flat::kReference], block, lane, blas, seen, first_number);
            else
                take(on_triangle(seen, block.triangle(lane)), first_number + id);
        }
    }

    void visit_reference(const flat::Reference& reference, const flat::BlockView& block, std::size_t lane,
                         const flat::Blas& blas, const Seen& seen, std::uint64_t first_number) {
        const PrimitiveRange& range = scene_.ranges[reference.range];
        const std::uint64_t number = first_number + range.first_number + reference.element;
        if (range.kind == PrimitiveKind::mesh)
            return visit_row(seen, range.kind, range.first_row, reference.element, number);
        if (range.kind != PrimitiveKind::instance)
            return visit_row(seen, range.kind, range.first_row + reference.element, 0, number);
        const double squared = to_box(seen, 1 / blas.scale, [&](std::size_t p) { return block.row(p)[lane]; });
        if (squared > best_squared_) return;
        const flat::Instance& instance = scene_.instances[range.first_row];
        const Transform m = placed(instance, seen.m, time_);
        visit(instance.blas, &m, number);
    }

    void visit_row(const Seen& seen, PrimitiveKind kind, std::size_t row, std::size_t element, std::uint64_t number) {
        if (kind == PrimitiveKind::mesh)
            return take(on_triangle(seen, flat::triangle_of(scene_, scene_.meshes[row], element)), number);
        primitives::with_row(scene_.rows, kind, row,
                             [&](const auto& primitive) { take(nearest_on(seen, primitive), number); });
    }

    static NearestPoint on_triangle(const Seen& seen, const TriangleVertices& v) {
        return nearest_on_triangle(seen.point(v.a), seen.point(v.b), seen.point(v.c));
    }
    static NearestPoint nearest_on(const Seen& seen, const primitives::Triangle& t) {
        return on_triangle(seen, {t.a, t.b, t.c});
    }
    static NearestPoint nearest_on(const Seen& seen, const primitives::Quad& q) {
        return nearest_on_quad(seen.point(q.corner), seen.vector(q.edge_u), seen.vector(q.edge_v));
    }
    static NearestPoint nearest_on(const Seen& seen, const primitives::Sphere& s) {
        return nearest_on_sphere(seen.point(s.center), std::abs(s.radius) * seen.size());
    }
    NearestPoint nearest_on(const Seen& seen, const primitives::MovingSphere& s) const {
        return nearest_on(seen, s.at(time_));
    }
    static NearestPoint nearest_on(const Seen& seen, const primitives::Disk& d) {
        const double size = seen.size();
        return nearest_on_disk(seen.point(d.center), normalize(seen.vector(normalize(d.normal))), d.radius * size);
    }

    void take(const NearestPoint& point, std::uint64_t number) {
        const double squared = length_squared(point.at);
        if (!(squared < best_squared_ || (squared == best_squared_ && number < best_.primitive))) return;
        best_squared_ = squared, best_.point = point, best_.primitive = number;
    }

    const flat::Scene& scene_;
    double time_, max_distance_, unit_ = 1, best_squared_ = kInfinity;
    Vec3 origin_;
    NearestSurface best_;
};

}  // namespace

NearestSurface closest_point(const flat::Scene& scene, const Point3& point, double max_distance, double time) {
    Walk walk(scene, point, max_distance, time);
    if (!scene.list.is_all) walk.visit_list();
    walk.visit(BlasId::root, nullptr, 0);
    for (const flat::Medium& medium : scene.media) walk.visit_medium(medium, nullptr, 0);
    return walk.nearest();
}

}  // namespace limn::trace
