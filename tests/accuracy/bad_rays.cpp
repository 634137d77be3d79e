// Rays that cannot be used, and rays from very far away that can.
#include <chrono>

#include "accuracy/bodies.h"
#include "accuracy/embree.h"
#include "accuracy/groups.h"
#include "accuracy/ray_row.h"

namespace limn::accuracy {

namespace {

struct BadRay {
    const char* name;
    void (*spoil)(Ray&);
};

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const BadRay kBadRays[] = {{"origin NaN", [](Ray& r) { r.origin.y = kNan; }},
                           {"origin infinite", [](Ray& r) { r.origin.x = -kInfinity; }},
                           {"direction NaN", [](Ray& r) { r.direction.z = kNan; }},
                           {"direction infinite", [](Ray& r) { r.direction.y = kInfinity; }},
                           {"direction zero",
                            [](Ray& r) {
                                r.direction = {0, -0.0, 0};
                            }},
                           {"t_min NaN", [](Ray& r) { r.t_min = kNan; }},
                           {"t_max NaN", [](Ray& r) { r.t_max = kNan; }},
                           {"t_min infinite", [](Ray& r) { r.t_min = kInfinity; }},
                           {"t_min above t_max", [](Ray& r) { r.t_min = 9, r.t_max = 8; }}};

std::vector<Ray> good_rays(std::size_t count) {
    test::Random random(11);
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < count; ++i)
        rays.push_back(ray_through(Point3{} + 3 * random.unit(), Point3{} + random.in_cube()));
    return rays;
}

// The least of several rounds, in nanoseconds a ray.
double cost(const std::function<void()>& once, std::size_t rays) {
    double least = kInfinity;
    for (int round = 0; round < 7; ++round) {
        const auto start = std::chrono::steady_clock::now();
        once();
        const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - start;
        least = std::min(least, took.count() / static_cast<double>(rays));
    }
    return least;
}

double cost_of_limn(const Subject& subject, const std::vector<Ray>& rays) {
    std::vector<Answer> answers;
    return cost([&] { subject.ask(Column::limn, rays, {}, answers); }, rays.size());
}

double cost_of_embree(Embree& embree, const std::vector<Ray>& rays) {
    std::vector<Answer> plain, robust;
    return cost([&] { embree.start(rays), embree.finish(plain, robust); }, rays.size());
}

}  // namespace

// Truth: all of them miss. cell.figure: time a bad ray over time a good one. Embree gets few rays, as each may cost a
// process; its figure is there only where none is aborted.
Group bad_ray_group(const Effort& effort) {
    Group group{"bad rays", "bad", {"limn", "limn, hit()"}, {}};
    const auto mesh = std::make_shared<const Subject>(closed_mesh(false, {}));
    const std::vector<Ray> good = good_rays(kBatch);
    const double good_cost = cost_of_limn(*mesh, good);

    std::unique_ptr<Embree> embree;
    double good_embree_cost = 0;
    if (Embree::is_there()) {
        group.columns.insert(group.columns.end(), {"Embree", "Embree robust"});
        embree = std::make_unique<Embree>();
        embree->set(mesh->geometry());
        good_embree_cost = cost_of_embree(*embree, good);
    }
    const std::size_t count = std::min<std::size_t>(kBatch, effort.rays);
    for (const BadRay& kind : kBadRays) {
        note(std::string("bad rays: ") + kind.name);
        std::vector<Ray> bad(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(count));
        for (Ray& ray : bad) kind.spoil(ray);
        const std::vector<Ray> few(bad.begin(),
                                   bad.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(8, count)));

        Row row;
        row.name = kind.name;
        row.cells.resize(group.columns.size());
        const auto judge = [&row](std::size_t column, const std::vector<Answer>& answers) {
            row.cells[column].asked = answers.size();
            for (const Answer& answer : answers) {
                row.cells[column].aborts += answer.aborted;
                row.cells[column].false_hits += answer.hit();
            }
        };
        row.rays = row.judged = count;
        std::vector<Answer> answers, robust;
        mesh->ask(Column::limn, bad, {}, answers);
        judge(0, answers);
        row.cells[0].figure = cost_of_limn(*mesh, bad) / good_cost;
        mesh->ask(Column::limn_hit, few, {}, answers);
        judge(1, answers);
        if (embree) {
            embree->start(few);
            embree->finish(answers, robust);
            judge(2, answers);
            judge(3, robust);
            if (row.cells[2].aborts + row.cells[3].aborts == 0)
                row.cells[2].figure = row.cells[3].figure = cost_of_embree(*embree, bad) / good_embree_cost;
        }
        group.rows.push_back(row);
    }
    return group;
}

Group far_origin_group(const Effort& effort) {
    std::vector<RayRow> rows;
    for (const double far : {1e12, 1e18, 1e25, 3e38}) {
        // Few rays from afar hit a body of size 1 unless they are parallel to an axis: so is every second.
        const auto ray = [far](test::Random& random, const Geometry&) {
            const std::size_t axis = random.index(3);
            Ray r;
            for (std::size_t a = 0; a < 3; ++a) r.origin[a] = to_float(random.uniform(-1.2, 1.2)), r.direction[a] = 0;
            const double side = random.sign();
            r.origin[axis] = to_float(side * far * random.uniform(0.5, 1));
            r.direction[axis] = -side;
            if (random.chance(0.5)) r.direction = to_float(Point3{} - r.origin);
            return r;
        };
        Geometry ball;
        ball.radius = 1;
        rows.push_back({.name = named("unit sphere from %.0e", far),
                        .x = far,
                        .fixed = std::make_shared<const Subject>(ball),
                        .ray = ray,
                        .lethal = far > 1e18});
        rows.push_back({.name = named("unit cube of triangles from %.0e", far),
                        .x = far,
                        .fixed = std::make_shared<const Subject>(
                            Geometry{.center = {}, .radius = 0, .mesh = test::cube_mesh(), .quads = {}}),
                        .ray = ray,
                        .lethal = far > 1e18});
    }
    return measure("far origins", "decisions", {Column::limn, Column::limn_hit, Column::embree, Column::embree_robust},
                   rows, effort.rays, effort.threads);
}

}  // namespace limn::accuracy
