// Queries that count and measure: all hits, crossings, what is inside, nearest points. Every triangle is looked at: a
// filter in double with a proven bound decides most of them, exact arithmetic the rest.
#include <optional>

#include "accuracy/groups.h"
#include "limn/query/compiled_scene.h"
#include "support/closed_meshes.h"

namespace limn::accuracy {

namespace {

using test::Real, test::Real3;
using Corners = std::array<Point3, 3>;

// The sign of a . (b x c) where the vectors are differences of doubles, each rounded once; 0 where rounding may have
// made it. Each of the products is off by 5 roundings at most, and so is the sum by 3 more.
int sign_of(const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto magnitudes = [](const Vec3& v) { return Vec3{std::abs(v.x), std::abs(v.y), std::abs(v.z)}; };
    const Vec3 p = magnitudes(b), q = magnitudes(c);
    const double permanent =
        dot(magnitudes(a), Vec3{p.y * q.z + p.z * q.y, p.z * q.x + p.x * q.z, p.x * q.y + p.y * q.x});
    const double determinant = dot(a, cross(b, c)), bound = 0x1p-48 * permanent + 0x1p-900;
    return determinant > bound ? 1 : determinant < -bound ? -1 : 0;
}

// What a ray from its origin on does to a triangle: whether it meets it, and whether it passes through it as moved,
// 1 along its normal.
struct Passage {
    bool met = false;
    int passed = 0;
};

class MeshTruth {
public:
    explicit MeshTruth(const MeshData& data) {
        for (const Index3& t : data.triangles) {
            const Corners k{test::vertex(data, t.a), test::vertex(data, t.b), test::vertex(data, t.c)};
            corners_.push_back(k);
            const Point3 middle = k[0] + ((k[1] - k[0]) + (k[2] - k[0])) / 3;
            middles_.push_back(middle);
            radii_.push_back(1.001 * std::max({length(k[0] - middle), length(k[1] - middle), length(k[2] - middle)}));
            for (const Point3& p : k) extent_ = std::max(extent_, max_abs(p - Point3{}));
        }
    }

    std::size_t size() const { return corners_.size(); }

    // \pre the ray's t_min is 0, its t_max infinite
    Passage pass(std::size_t i, const Ray& ray) const {
        if (is_beside(i, ray)) return {};
        const Corners& k = corners_[i];
        const Vec3 a = k[0] - ray.origin, b = k[1] - ray.origin, c = k[2] - ray.origin, d = ray.direction;
        const int ab = sign_of(d, a, b), bc = sign_of(d, b, c), ca = sign_of(d, c, a);
        if (std::max({ab, bc, ca}) - std::min({ab, bc, ca}) == 2) return {};
        if (const int side = sign_of(a, b, c); side != 0 && ab != 0 && ab == bc && bc == ca)
            return {side == ab, side == ab ? ab : 0};
        return {test::exact_triangle_hit(k[0], k[1], k[2], ray).hit,
                test::exact_moved_passage(k[0], k[1], k[2], ray.origin, d)};
    }

    bool is_on(std::size_t i, const Point3& p) const {
        if (length(p - middles_[i]) > radii_[i] + 1e-9 * extent_) return false;
        const Corners& k = corners_[i];
        return sign_of(k[0] - p, k[1] - p, k[2] - p) == 0 && test::exactly_on_triangle(k[0], k[1], k[2], p);
    }

    // From the point to the mesh, off by far less than `allowed`.
    Real distance(const Point3& p) const {
        double upper = kInfinity;
        for (std::size_t i = 0; i < size(); ++i) upper = std::min(upper, length(p - middles_[i]) + radii_[i]);
        Real nearest = kInfinity;
        for (std::size_t i = 0; i < size(); ++i)
            if (length(p - middles_[i]) - radii_[i] <= upper) nearest = std::min(nearest, distance(i, p));
        return nearest;
    }
    Real distance(std::size_t i, const Point3& p) const {
        const Corners& k = corners_[i];
        // A normal is off by some roundings of the edges' product, and the foot on its plane by as much of the
        // distance.
        const Vec3 ab = k[1] - k[0], ac = k[2] - k[0];
        const bool is_sliver = length(cross(ab, ac)) < 0x1p-14 * length(ab) * length(ac);
        return is_sliver ? distance<Real, Real3>(k, p) : Real(distance<double, Vec3>(k, p));
    }
    // What a distance from p may be off by.
    Real allowed(const Point3& p) const { return Real(0x1p-32) * Real(std::max(extent_, max_abs(p - Point3{}))); }

private:
    template <class Number, class Vector>
    static Number distance(const Corners& k, const Point3& p) {
        const auto seen = [&](const Point3& q) { return Vector(q - Point3{}) - Vector(p - Point3{}); };
        const Vector a = seen(k[0]), b = seen(k[1]), c = seen(k[2]), n = cross(b - a, c - a);
        if (dot(n, cross(a, b)) >= 0 && dot(n, cross(b, c)) >= 0 && dot(n, cross(c, a)) >= 0) {
            const Number height = dot(a, n) / length(n);
            return height < 0 ? -height : height;
        }
        const auto to_segment = [](const Vector& from, const Vector& to) {
            const Vector edge = to - from;
            return length(from + std::clamp(-dot(from, edge) / dot(edge, edge), Number(0), Number(1)) * edge);
        };
        return std::min({to_segment(a, b), to_segment(b, c), to_segment(c, a)});
    }
    // Whether the line passes the ball around the triangle, beyond any doubt of rounding.
    bool is_beside(std::size_t i, const Ray& ray) const {
        const Vec3 q = middles_[i] - ray.origin;
        const double radius = radii_[i] + 1e-9 * (max_abs(q) + extent_);
        return length_squared(cross(q, ray.direction)) > 1.001 * radius * radius * length_squared(ray.direction);
    }

    std::vector<Corners> corners_;
    std::vector<Point3> middles_;
    std::vector<double> radii_;
    double extent_ = 0;
};

struct Subject {
    std::string name;
    MeshData data;
    MeshTruth truth;
    CompiledScene scene;

    explicit Subject(const test::QueryMesh& mesh)
        : name(mesh.name), data(mesh.data), truth(mesh.data), scene([&] {
              Scene described;
              described.add(std::make_shared<Mesh>(mesh.data, nullptr));
              return compile(described);
          }()) {}
};

struct Judge {
    const Subject& subject;

    // \return whether all_hits and the crossings are right, and whether there are as many crossings as hits
    std::array<bool, 3> rays_right(const Ray& ray) const {
        const MeshTruth& truth = subject.truth;
        const std::vector<RayHit> hits = subject.scene.all_hits(ray);
        const std::vector<RayCrossing> crossings = subject.scene.crossings(ray);
        std::vector<int> met(truth.size()), passed(truth.size());
        bool all_hits = true, counted = true;
        for (std::size_t i = 0; i < hits.size(); ++i) {
            ++met[hits[i].primitive];
            all_hits = all_hits && (i == 0 || hits[i - 1].t < hits[i].t ||
                                    (hits[i - 1].t == hits[i].t && hits[i - 1].primitive < hits[i].primitive));
        }
        const auto closest = subject.scene.closest_hit(ray);
        all_hits = all_hits && closest.has_value() == !hits.empty() &&
                   (!closest || (closest->t == hits[0].t && closest->primitive == hits[0].primitive));
        for (const RayCrossing& c : crossings) passed[c.primitive] += c.inward ? -1 : 1;
        std::size_t count = 0;
        std::int64_t outward = 0;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const Passage p = truth.pass(i, ray);
            all_hits = all_hits && met[i] == (p.met ? 1 : 0);
            counted = counted && passed[i] == p.passed;
            count += p.passed != 0 ? 1 : 0, outward += p.passed;
        }
        counted = counted && crossings.size() == count && subject.scene.count_intersections(ray) == count &&
                  subject.scene.winding_number(ray) == outward;
        return {all_hits, counted, hits.size() == count};
    }

    // \return whether the winding number and contains are right, and the nearest point and the signed distance
    std::pair<bool, bool> points_right(const Point3& p, const Vec3& direction) const {
        const MeshTruth& truth = subject.truth;
        const Ray ray{.origin = p, .direction = direction};
        std::int64_t winding = 0;
        bool on = false;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            winding += truth.pass(i, ray).passed;
            on = on || truth.is_on(i, p);
        }
        const PointLocation found = subject.scene.locate(p);
        const bool is_inside = on || winding != 0;
        bool located = found.winding_number == winding && found.on_surface == on;
        located = located && subject.scene.contains(p) == is_inside && (!on || truth.is_on(found.primitive, p));
        const auto nearest = subject.scene.closest_point(p);
        if (!nearest) return {located, false};
        const Real distance = truth.distance(p), allowed = truth.allowed(p);
        const auto is_near = [&](Real a, Real b) { return test::absolute(a - b) <= allowed; };
        const bool near = is_near(nearest->distance, distance) &&
                          is_near(truth.distance(nearest->element, p), distance) &&
                          is_near(length(Real3(nearest->position) - Real3(p)), distance);
        const double with_sign = subject.scene.signed_distance(p);
        return {located, near && (on ? with_sign == 0 : with_sign == (is_inside ? -1 : 1) * nearest->distance)};
    }
};

constexpr const char* kAims[] = {"vertices", "edges", "faces", "in planes of faces", "along axes", "anywhere"};

// Of the surface where the rays aim at it, in three of four cases beside it by an ulp or by anything.
Point3 point_for(test::Random& random, const MeshData& data, test::Aim aim) {
    const std::size_t kind = aim <= test::Aim::face ? static_cast<std::size_t>(aim) : random.index(3);
    Point3 p = test::point_of(random, data, kind);
    switch (random.index(4)) {
        case 0: return p;
        case 1:
            for (std::size_t a = 0; a < 3; ++a)
                if (random.chance(0.5)) p[a] = std::nextafter(p[a], random.sign() * 1e300);
            return p;
        default: return p + random.log_uniform(1e-15, 2) * random.unit();
    }
}

}  // namespace

Group query_group(const Effort& effort) {
    Group group{"queries",
                "queries",
                {"limn, all hits", "limn, crossings", "limn, inside", "limn, nearest", "hits counted"},
                {}};
    test::Random meshes(611);
    std::vector<Subject> subjects;
    for (const test::QueryMesh& mesh : test::query_meshes(meshes))
        if (mesh.name != "cube" && mesh.name != "U") subjects.emplace_back(mesh);
    const std::uint64_t rays = std::max<std::uint64_t>(1, effort.leak_rays / (subjects.size() * std::size(kAims)) + 1);
    for (const Subject& subject : subjects)
        for (std::size_t a = 0; a < std::size(kAims); ++a) {
            const auto aim = static_cast<test::Aim>(a);
            Row empty{.name = subject.name + ", " + kAims[a], .cells = std::vector<Cell>(group.columns.size())};
            const auto maker = [&]() -> Work {
                return [&](std::uint64_t chunk, std::size_t count, Row& sum) {
                    test::Random random(seed_of(empty.name, chunk));
                    Judge judge{subject};
                    for (std::size_t i = 0; i < count; ++i) {
                        Ray ray = test::query_ray(random, subject.data, aim);
                        ray.t_min = 0, ray.t_max = kInfinity;
                        const auto [all_hits, crossings, as_many] = judge.rays_right(ray);
                        const auto [inside, nearest] =
                            judge.points_right(point_for(random, subject.data, aim), random.unit());
                        const bool right[] = {all_hits, crossings, inside, nearest, as_many};
                        for (std::size_t c = 0; c < std::size(right); ++c)
                            ++sum.cells[c].asked, sum.cells[c].false_hits += right[c] ? 0 : 1;
                    }
                    sum.rays += count, sum.judged += count;
                };
            };
            group.rows.push_back(add_up(empty, rays, 512, effort.threads, maker));
        }
    return group;
}

}  // namespace limn::accuracy
