#include "accuracy/subject.h"

#include "accuracy/textbook.h"
#include "limn/scene/shape/hittable_list.h"
#include "limn/scene/shape/instance.h"
#include "limn/scene/shape/quad.h"
#include "limn/scene/shape/sphere.h"

namespace limn::accuracy {

namespace {

using textbook::as;

std::shared_ptr<const Hittable> describe(const Geometry& g) {
    std::shared_ptr<const Hittable> shape;
    if (g.radius > 0) {
        shape = std::make_shared<Sphere>(g.center, g.radius, nullptr);
    } else if (g.quads.size() == 1) {
        shape = std::make_shared<Quad>(g.quads[0].corner, g.quads[0].edge_u, g.quads[0].edge_v, nullptr);
    } else if (!g.quads.empty()) {
        std::vector<std::shared_ptr<const Hittable>> list;
        for (const Parallelogram& q : g.quads)
            list.push_back(std::make_shared<Quad>(q.corner, q.edge_u, q.edge_v, nullptr));
        shape = std::make_shared<HittableList>(std::move(list));
    } else {
        shape = std::make_shared<Mesh>(g.mesh, nullptr);
    }
    return g.world_from_object ? std::make_shared<Instance>(shape, *g.world_from_object) : shape;
}

}  // namespace

std::string name_of(Column column) {
    switch (column) {
        case Column::limn: return "limn";
        case Column::limn_hit: return "limn, hit()";
        case Column::embree: return "Embree";
        case Column::embree_robust: return "Embree robust";
        case Column::moeller_trumbore: return "Möller-Trumbore float32";
        case Column::pluecker: return "Plücker float32";
        case Column::book_sphere_float: return "book, float32";
        case Column::book_sphere_double: return "book, double";
        case Column::book_quad: return "book, double";
    }
    return {};
}

Subject::Subject(Geometry geometry)
    : geometry_(std::move(geometry)), shape_(describe(geometry_)), near_(geometry_.mesh, geometry_.in_fours) {
    Scene scene;
    scene.add(shape_);
    scene_ = std::make_unique<const CompiledScene>(compile(scene));
    if (geometry_.world_from_object) {
        chain_.push_back(*geometry_.world_from_object);
        const Transform back = inverse(*geometry_.world_from_object);
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 4; ++j) object_from_world_[i][j] = static_cast<float>(back.rows[i][j]);
    }
}

void Subject::find_near(std::span<const Ray> rays, Near& near) const {
    near.triangles.clear();
    near.first.assign(1, 0);
    for (const Ray& ray : rays) {
        near_.find(ray, near.triangles);
        near.first.push_back(near.triangles.size());
    }
}

void Subject::ask(Column column, std::span<const Ray> rays, const Near& near, std::vector<Answer>& answers) const {
    answers.assign(rays.size(), {});
    const Geometry& g = geometry_;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Ray& ray = rays[i];
        Answer& answer = answers[i];
        const auto nearest = [&answer](double t, std::size_t primitive) {
            if (t < answer.t) answer.t = t, answer.primitive = static_cast<std::uint32_t>(primitive);
        };
        const auto among_triangles = [&](float (*kernel)(const textbook::F&, const textbook::F&, const textbook::F&,
                                                         const textbook::F&, const textbook::F&)) {
            for (std::size_t place = near.first[i]; place < near.first[i + 1]; ++place) {
                const std::uint32_t k = near.triangles[place];
                const Index3& f = g.mesh.triangles[k];
                nearest(static_cast<double>(kernel(as<float>(ray.origin), as<float>(ray.direction),
                                                   as<float>(g.mesh.vertices[f.a]), as<float>(g.mesh.vertices[f.b]),
                                                   as<float>(g.mesh.vertices[f.c]))),
                        k);
            }
        };
        switch (column) {
            case Column::limn:
                if (const auto hit = scene_->closest_hit(ray))
                    answer = {hit->t, hit->u, hit->v, static_cast<std::uint32_t>(hit->element)};
                break;
            case Column::limn_hit:
                if (const auto hit = shape_->hit(ray))
                    answer = {hit->t, hit->u, hit->v, static_cast<std::uint32_t>(hit->element)};
                break;
            case Column::moeller_trumbore: among_triangles(textbook::moeller_trumbore); break;
            case Column::pluecker: among_triangles(textbook::pluecker); break;
            case Column::book_sphere_float: {
                textbook::F origin = as<float>(ray.origin), direction = as<float>(ray.direction);
                if (g.world_from_object) {
                    const auto& m = object_from_world_;
                    const auto row = [&m](const textbook::F& v, int k) {
                        return m[k][0] * v.x + m[k][1] * v.y + m[k][2] * v.z;
                    };
                    const textbook::F o = origin, d = direction;
                    origin = {row(o, 0) + m[0][3], row(o, 1) + m[1][3], row(o, 2) + m[2][3]};
                    direction = {row(d, 0), row(d, 1), row(d, 2)};
                }
                nearest(static_cast<double>(textbook::sphere(origin, direction, as<float>(g.center),
                                                             static_cast<float>(g.radius), 0.0F)),
                        0);
                break;
            }
            case Column::book_sphere_double:
                nearest(textbook::sphere(as<double>(ray.origin), as<double>(ray.direction), as<double>(g.center),
                                         g.radius, 0.0),
                        0);
                break;
            case Column::book_quad:
                for (std::size_t k = 0; k < g.quads.size(); ++k) {
                    const Parallelogram& q = g.quads[k];
                    nearest(textbook::quad(as<double>(ray.origin), as<double>(ray.direction), as<double>(q.corner),
                                           as<double>(q.edge_u), as<double>(q.edge_v)),
                            k);
                }
                break;
            case Column::embree:
            case Column::embree_robust: throw std::logic_error("Embree is asked in its own process");
        }
    }
}

std::uint32_t Subject::primitives() const {
    if (geometry_.radius > 0) return 1;
    return static_cast<std::uint32_t>(geometry_.quads.empty() ? geometry_.mesh.triangles.size()
                                                              : geometry_.quads.size());
}

test::ExactHit Subject::truth(const Ray& ray, std::uint32_t primitive) const {
    const Geometry& g = geometry_;
    if (primitive >= primitives()) return {};
    if (g.radius > 0) return test::exact_sphere_hit(g.center, g.radius, ray, chain_);
    if (!g.quads.empty()) {
        const Parallelogram& q = g.quads[primitive];
        return test::exact_quad_hit(q.corner, q.edge_u, q.edge_v, ray, chain_);
    }
    const Index3& f = g.mesh.triangles[primitive];
    return test::exact_triangle_hit(to_point(g.mesh.vertices[f.a]), to_point(g.mesh.vertices[f.b]),
                                    to_point(g.mesh.vertices[f.c]), ray, chain_);
}

Subject::Truth Subject::truth(const Ray& ray) const {
    std::vector<std::uint32_t> candidates;
    if (geometry_.mesh.triangles.empty()) {
        for (std::uint32_t k = 0; k < primitives(); ++k) candidates.push_back(k);
    } else {
        near_.find(ray, candidates);
    }
    Truth nearest;
    for (const std::uint32_t k : candidates) {
        const test::ExactHit hit = truth(ray, k);
        if (hit.hit && (!nearest.hit.hit || hit.t < nearest.hit.t)) nearest = {hit, k};
    }
    return nearest;
}

}  // namespace limn::accuracy
