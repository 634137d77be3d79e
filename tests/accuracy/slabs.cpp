// Rays against boxes. limn's own test may say yes to a box that a ray just passes by, never no to one that it meets:
// only false misses are faults, for a box that is missed loses what is inside.
#include "accuracy/bodies.h"
#include "accuracy/groups.h"
#include "accuracy/ray_row.h"
#include "accuracy/textbook.h"
#include "geometry/bvh/slab.h"

namespace limn::accuracy {

namespace {

struct Question {
    Box box;
    Ray ray;
};

double zero(test::Random& random) { return std::copysign(0.0, random.sign()); }

Box unit_box(test::Random& random, double size = 1, double far = 0) {
    const Point3 lower = to_float(Point3{far, far, far} + random.in_cube(size));
    const Vec3 sides{random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1)};
    return {lower, to_float(lower + size * sides)};
}

// A corner of the box; on the way along `free` axes any point.
Point3 border_point(test::Random& random, const Box& b, int free) {
    Point3 p;
    for (std::size_t a = 0; a < 3; ++a) p[a] = random.chance(0.5) ? b.lower[a] : b.upper[a];
    const std::size_t first = random.index(3);
    for (int k = 0; k < free; ++k) {
        const std::size_t a = (first + static_cast<std::size_t>(k)) % 3;
        p[a] = to_float(random.uniform(b.lower[a], b.upper[a]));
    }
    return p;
}

Question aimed(test::Random& random, double size, double far, int free) {
    const Box b = unit_box(random, size, far);
    const Point3 target = border_point(random, b, free);
    return {b, ray_through(target + 3 * size * random.unit(), target)};
}

// A ray in the plane of one face (components: how many of its direction are zero), from outside the box or inside it.
Question in_face(test::Random& random, bool low, int zeros) {
    const Box b = unit_box(random);
    Ray ray = ray_through(Point3{} + 3 * random.unit(), b.lower + 0.5 * b.diagonal());
    const std::size_t first = random.index(3);
    for (int k = 0; k < zeros; ++k) {
        const std::size_t a = (first + static_cast<std::size_t>(k)) % 3;
        ray.direction[a] = zero(random);
        ray.origin[a] = low ? b.lower[a] : b.upper[a];
    }
    return {b, ray};
}

Question flat(test::Random& random, int axes, bool from_within) {
    Box b = unit_box(random);
    const std::size_t first = random.index(3);
    for (int k = 0; k < axes; ++k)
        b.upper[(first + static_cast<std::size_t>(k)) % 3] = b.lower[(first + static_cast<std::size_t>(k)) % 3];
    Point3 target = border_point(random, b, 3);
    for (int k = 0; k < axes; ++k)
        target[(first + static_cast<std::size_t>(k)) % 3] = b.lower[(first + static_cast<std::size_t>(k)) % 3];
    Ray ray = ray_through(target + 3 * random.unit(), target);
    if (from_within) ray.origin = target;
    return {b, ray};
}

Question on_face_leaving(test::Random& random) {
    const Box b = unit_box(random);
    Ray ray;
    ray.origin = border_point(random, b, 2);
    ray.direction = to_float(random.unit());
    return {b, ray};
}

Question of_length(test::Random& random, double size) {
    Question q = aimed(random, 1, 0, 3);
    q.ray.direction = to_float(size * normalize(q.ray.direction));
    return q;
}

struct Configuration {
    const char* name;
    Question (*ask)(test::Random&);
};

const Configuration kConfigurations[] = {
    {"one component ±0, origin on the low face", [](test::Random& r) { return in_face(r, true, 1); }},
    {"one component ±0, origin on the high face", [](test::Random& r) { return in_face(r, false, 1); }},
    {"two components ±0, origin on a low edge", [](test::Random& r) { return in_face(r, true, 2); }},
    {"two components ±0, origin on a high edge", [](test::Random& r) { return in_face(r, false, 2); }},
    {"flat box, crossed", [](test::Random& r) { return flat(r, 1, false); }},
    {"flat box, from within", [](test::Random& r) { return flat(r, 1, true); }},
    {"box that is a segment", [](test::Random& r) { return flat(r, 2, false); }},
    {"box that is a point, from it", [](test::Random& r) { return flat(r, 3, true); }},
    {"origin on a face", on_face_leaving},
    {"direction of length 1e-30", [](test::Random& r) { return of_length(r, 1e-30); }},
    {"direction of length 1e+25", [](test::Random& r) { return of_length(r, 1e25); }},
    {"corners at 0", [](test::Random& r) { return aimed(r, 1, 0, 0); }},
    {"corners at 1e+03", [](test::Random& r) { return aimed(r, 1, 1e3, 0); }},
    {"corners at 1e+05", [](test::Random& r) { return aimed(r, 1, 1e5, 0); }},
    {"edges at 0", [](test::Random& r) { return aimed(r, 1, 0, 1); }},
    {"edges of a box of 1e-3 at 1e+03", [](test::Random& r) { return aimed(r, 1e-3, 1e3, 1); }},
    {"points inside at 1e+03", [](test::Random& r) { return aimed(r, 1, 1e3, 3); }}};

bool limn_meets(const Question& q) {
    double near = 0;
    const accel::SlabRay slab(q.ray, accel::finite_extent(q.box));
    return slab.meets(q.box, q.ray.t_max, near);
}

template <class Real>
bool book_meets(const Question& q) {
    Real origin[3], direction[3], lower[3], upper[3];
    for (std::size_t a = 0; a < 3; ++a) {
        origin[a] = static_cast<Real>(q.ray.origin[a]), direction[a] = static_cast<Real>(q.ray.direction[a]);
        lower[a] = static_cast<Real>(q.box.lower[a]), upper[a] = static_cast<Real>(q.box.upper[a]);
    }
    return textbook::meets_box(origin, direction, lower, upper);
}

}  // namespace

Group slab_group(const Effort& effort) {
    Group group{"slabs", "leaks", {"limn", "book, float32", "book, double"}, {}};
    for (const Configuration& configuration : kConfigurations) {
        note(std::string("slabs: ") + configuration.name);
        Row empty;
        empty.name = configuration.name;
        empty.cells.resize(3);
        const auto maker = [&]() -> Work {
            return [&](std::uint64_t chunk, std::size_t count, Row& sum) {
                test::Random random(seed_of(configuration.name, chunk));
                for (std::size_t i = 0; i < count; ++i) {
                    const Question q = configuration.ask(random);
                    ++sum.rays, ++sum.judged;
                    for (Cell& cell : sum.cells) ++cell.asked;
                    const bool answers[] = {limn_meets(q), book_meets<float>(q), book_meets<double>(q)};
                    if (answers[0] && answers[1] && answers[2]) continue;  // no miss to judge
                    if (!test::exact_box_hit(q.box, q.ray)) continue;
                    for (std::size_t k = 0; k < 3; ++k) sum.cells[k].false_misses += !answers[k];
                }
            };
        };
        group.rows.push_back(add_up(empty, effort.rays, kBatch, effort.threads, maker));
    }
    return group;
}

}  // namespace limn::accuracy
