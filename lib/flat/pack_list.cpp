#include "flat/pack_list.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "geometry/exact.h"
#include "geometry/sphere_side.h"

namespace limn::compiler {

namespace {

using flat::PrimitiveList;

// The rounding error of an instanced vertex, relative to the magnitudes that enter it: 4 products and sums, and some
// slack.
constexpr double kInstanceError = 8 * kRoundoff;
// The smallest thickness of a listed primitive, relative to the scene. Float is too imprecise for a thinner one.
constexpr double kSmallest = 0x1p-12;
// The smallest area of a listed candidate, relative to the bounds of the rest (measured: docs/tried.md). Most rays
// would test such a candidate in a tree too.
constexpr double kLarge = 0.1;
constexpr std::size_t kMostLarge = 24;
// If there are at most this many candidates beside meshes, all are listed. The tree then has triangles alone, and is
// smaller.
constexpr std::size_t kFew = 16;

// Returns half the area of the box: infinity if a side is infinite.
double half_area(const Box& box) {
    if (box.is_empty()) return 0;
    const Vec3 d = box.diagonal();
    return max_abs(d) < kInfinity ? d.x * d.y + d.y * d.z + d.z * d.x : kInfinity;
}

// Fills Scene::list.
class Lister {
public:
    explicit Lister(flat::Scene& scene) : scene_(scene), root_(flat::blas_at(scene, BlasId::root)) {}

    // Lists all primitives of the scene. Returns false if this isn't possible.
    bool list_all() {
        if (!is_in_range() || scene_.stored_primitives > PrimitiveList::kMost || !add_blas(root_, 0, {})) return false;
        if (entries_.empty() || entries_.size() > PrimitiveList::kMost) return false;
        pack();
        scene_.list.is_all = true;
        return true;
    }

    // Lists candidates from the largest on, as long as they are large compared with the rest.
    std::vector<bool> list_large(std::span<const Candidate> candidates, const Box& others) {
        std::vector<bool> is_listed(candidates.size(), false);
        if (!is_in_range()) return is_listed;
        // Sort the largest candidates by size, no more than the list can hold.
        std::vector<std::size_t> order(candidates.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        const std::size_t some = std::min(order.size(), PrimitiveList::kMost);
        std::ranges::partial_sort(order, order.begin() + static_cast<std::ptrdiff_t>(some), {},
                                  [&](std::size_t i) { return std::pair(-half_area(candidates[i].box), i); });
        // Compute the bounds of each candidate with all smaller ones and the others.
        std::vector<Box> rest(some + 1, others);
        for (std::size_t i = some; i < order.size(); ++i) rest[some].extend(candidates[order[i]].box);
        for (std::size_t i = some; i-- > 0;) rest[i] = merge(rest[i + 1], candidates[order[i]].box);
        // List the candidates.
        const bool are_few = candidates.size() <= kFew;
        Box passed_over;  // bounds of the candidates that can't be listed
        for (std::size_t i = 0; i < some && entries_.size() < kMostLarge; ++i) {
            const Candidate& c = candidates[order[i]];
            if (!are_few && !(half_area(c.box) >= kLarge * half_area(merge(rest[i], passed_over)))) break;
            is_listed[order[i]] = add_candidate(c.reference);
            if (!is_listed[order[i]]) passed_over.extend(c.box);
        }
        if (!entries_.empty()) pack();
        return is_listed;
    }

private:
    // Returns true if float can hold the scene's coordinates and their products.
    bool is_in_range() const { return root_.scale == 1 && root_.extent > 0x1p-20 && root_.extent < 0x1p39; }

    // Lists a candidate; if it's an instance, all of its primitives. Otherwise changes nothing and returns false.
    bool add_candidate(const flat::Reference& reference) {
        const PrimitiveRange& range = scene_.ranges[reference.range];
        if (range.kind == PrimitiveKind::sphere) return false;  // the tree is faster for it: see docs/tried.md
        if (range.kind != PrimitiveKind::instance)
            return add(range, reference.element, range.first_number + reference.element, {});
        const std::size_t before = entries_.size();
        if (add_instance(range, range.first_number)) return true;
        entries_.resize(before);
        return false;
    }

    // Lists the primitives of a still instance. Returns false if not all could be listed.
    bool add_instance(const PrimitiveRange& range, std::uint64_t number) {
        const flat::Instance& instance = scene_.instances[range.first_row];
        return !instance.moving && add_blas(flat::blas_at(scene_, instance.blas), number, range.first_row);
    }

    // Lists the primitives of a BLAS, seen through `instance` if there is one. Returns false if not all could be
    // listed.
    bool add_blas(const flat::Blas& blas, std::uint64_t first_number, std::optional<std::uint32_t> instance) {
        for (const PrimitiveRange& range : flat::ranges_of(scene_, blas)) {
            const std::uint64_t number = first_number + range.first_number;
            if (range.kind == PrimitiveKind::instance) {
                if (instance || !add_instance(range, number)) return false;
                continue;
            }
            if (range.kind == PrimitiveKind::medium) continue;  // media aren't part of the list
            for (std::uint64_t e = 0; e < range.count; ++e)
                if (!add(range, static_cast<std::uint32_t>(e), number + e, instance)) return false;
        }
        return true;
    }

    // Lists one primitive. Returns false if its kind can't be listed, the list is full, or float is too imprecise for
    // it.
    bool add(const PrimitiveRange& range, std::uint32_t element, std::uint64_t number,
             std::optional<std::uint32_t> instance) {
        // Check the kind.
        const unsigned listed = flat::kPlanarKinds | (instance ? 0 : flat::bit(PrimitiveKind::sphere));
        if (entries_.size() == PrimitiveList::kMost || (flat::bit(range.kind) & listed) == 0) return false;
        // Fill in the entry.
        PrimitiveList::Entry e;
        e.kind = range.kind;
        e.number = number;
        e.row = range.first_row + element;
        e.is_instanced = instance.has_value();
        e.instance = instance.value_or(0);
        if (range.kind == PrimitiveKind::mesh) {
            e.row = range.first_row;
            e.element = element;
        }
        bool has_area = true;
        flat::with_primitive(scene_, range, element, [&]<class Kind>(const Kind& primitive) {
            if constexpr (Kind::kKind == PrimitiveKind::sphere) {
                e.corner = primitive.center;
                e.radius = std::abs(primitive.radius);
            }
            if constexpr (Kind::kKind == PrimitiveKind::triangle)
                has_area = !are_collinear(primitive.a, primitive.b, primitive.c);
            if constexpr (requires { primitive.patch(); }) {
                const primitives::Patch patch = primitive.patch();
                e.corner = patch.corner;
                e.edge_u = patch.edge_u;
                e.edge_v = patch.edge_v;
            }
        });
        if (!has_area) return true;  // no ray can hit it
        // Transform it to world space.
        if (instance) {
            const Transform& matrix = scene_.instances[*instance].world_from_object0;
            const double size = max_abs(e.corner) + max_abs(e.edge_u) + max_abs(e.edge_v);
            for (const auto& m : matrix.rows) {
                const double most = sum_of_magnitudes({m[0], m[1], m[2]}) * size + std::abs(m[3]);
                e.error = std::max(e.error, kInstanceError * most);
            }
            e.corner = transform_point(matrix, e.corner);
            e.edge_u = transform_vector(matrix, e.edge_u);
            e.edge_v = transform_vector(matrix, e.edge_v);
        }
        // Check that float is precise enough for it.
        if (!(e.kind == PrimitiveKind::sphere ? e.radius > kSmallest * root_.extent : is_plane_clear(e))) return false;
        entries_.push_back(e);
        return true;
    }

    // Returns true if float is precise enough for the weights of its edges.
    bool is_plane_clear(const PrimitiveList::Entry& e) const {
        return e.error < 0x1p-40 * root_.extent && Weights(e).spread * root_.extent < 1 / kSmallest;
    }

    // Writes the entries and their packed rows to Scene::list.
    void pack() {
        // Sort the entries by kind, then by number.
        const auto rank = [](const PrimitiveList::Entry& e) {
            return e.kind == PrimitiveKind::quad ? 0 : e.kind == PrimitiveKind::sphere ? 2 : 1;
        };
        std::ranges::sort(entries_, {}, [&](const PrimitiveList::Entry& e) { return std::pair(rank(e), e.number); });
        PrimitiveList& list = scene_.list;
        for (const PrimitiveList::Entry& e : entries_)
            ++(rank(e) == 0 ? list.quads : rank(e) == 1 ? list.triangles : list.spheres);
        list.entries = std::move(entries_);
        // Write the rows.
        const auto padded = [](std::uint32_t n) {
            constexpr std::uint32_t kAlign = PrimitiveList::kAlign;
            return (n + kAlign - 1) / kAlign * kAlign;
        };
        list.planar_stride = padded(list.planars());
        list.sphere_stride = padded(list.spheres);
        list.planar.assign(PrimitiveList::kPlanarRows * list.planar_stride, 0);
        list.round.assign(PrimitiveList::kSphereRows * list.sphere_stride, 0);
        for (std::uint32_t i = 0; i < list.planars(); ++i) pack_planar(list.entries[i], list, i);
        for (std::uint32_t i = 0; i < list.spheres; ++i) {
            const PrimitiveList::Entry& e = list.entries[list.planars() + i];
            float* rows = list.round.data() + i;
            for (std::size_t a = 0; a < 3; ++a) rows[a * list.sphere_stride] = static_cast<float>(e.corner[a]);
            rows[PrimitiveList::kRadius * list.sphere_stride] = static_cast<float>(e.radius);
        }
    }

    // The vectors of a packed planar primitive (see PrimitiveList), in double. normal . x is constant on the plane.
    // u . x increases by 1 along edge_u and is constant along edge_v. For v . x it is the other way round.
    struct Weights {
        Vec3 normal, u, v;
        double spread;  // the larger of the sums of the magnitudes of u's and of v's components

        explicit Weights(const PrimitiveList::Entry& e) {
            const Vec3 n = cross(e.edge_u, e.edge_v);
            const double squared = dot(n, n);
            normal = n / max_abs(n);
            u = cross(e.edge_v, n) / squared;
            v = cross(n, e.edge_u) / squared;
            spread = std::max(sum_of_magnitudes(u), sum_of_magnitudes(v));
        }
    };

    // Writes the packed numbers of a planar primitive to column i of the rows.
    static void pack_planar(const PrimitiveList::Entry& e, PrimitiveList& list, std::uint32_t i) {
        const auto [normal, u, v, spread] = Weights(e);
        const Vec3 corner = e.corner - Point3{};
        const double offset = dot(normal, corner), u_offset = dot(u, corner), v_offset = dot(v, corner);
        const auto put = [&](std::size_t row, double x) {
            list.planar[row * list.planar_stride + i] = static_cast<float>(x);
        };
        for (std::size_t a = 0; a < 3; ++a) {
            put(PrimitiveList::kNormal + a, normal[a]);
            put(PrimitiveList::kU + a, u[a]);
            put(PrimitiveList::kV + a, v[a]);
        }
        put(PrimitiveList::kOffset, offset);
        put(PrimitiveList::kUOffset, u_offset);
        put(PrimitiveList::kVOffset, v_offset);
        put(PrimitiveList::kSpread, 2 * spread * (1 + 0x1p-20));
    }

    flat::Scene& scene_;
    const flat::Blas& root_;
    std::vector<PrimitiveList::Entry> entries_;
};

}  // namespace

bool list_all(flat::Scene& scene) { return Lister(scene).list_all(); }

std::vector<bool> list_large(flat::Scene& scene, std::span<const Candidate> candidates, const Box& others) {
    return Lister(scene).list_large(candidates, others);
}

}  // namespace limn::compiler
