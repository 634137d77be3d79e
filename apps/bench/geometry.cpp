#include "bench/geometry.h"

#include "limn/shape/instance.h"
#include "limn/shape/quad.h"
#include "limn/shape/sphere.h"

namespace limn::bench {

Scene describe(const Geometry& geometry) {
    Scene scene;
    scene.name = geometry.name;
    if (geometry.mesh && geometry.places.empty()) scene.add(geometry.mesh);
    for (const Transform& place : geometry.places) scene.add(std::make_shared<Instance>(geometry.mesh, place));
    for (const Ball& ball : geometry.balls) scene.add(std::make_shared<Sphere>(ball.center, ball.radius, nullptr));
    for (const Parallelogram& q : geometry.quads)
        scene.add(std::make_shared<Quad>(q.corner, q.edge_u, q.edge_v, nullptr));
    return scene;
}

std::size_t stored_primitives(const Geometry& geometry) {
    const std::size_t triangles = geometry.mesh ? geometry.mesh->data().triangles.size() : 0;
    return triangles + geometry.places.size() + geometry.balls.size() + geometry.quads.size();
}

}  // namespace limn::bench
