// Asks two rays what they hit.
#include <limn/query/compiled_scene.h>
#include <limn/scene/shape/sphere.h>

int main() {
    limn::Scene scene;
    scene.add(std::make_shared<limn::Sphere>(limn::Point3{0, 0, 0}, 1.0, nullptr));
    const limn::CompiledScene compiled = limn::compile(scene);
    const auto hit = compiled.closest_hit({.origin = {0, 0, 5}, .direction = {0, 0, -1}});
    const auto miss = compiled.closest_hit({.origin = {2, 0, 5}, .direction = {0, 0, -1}});
    return hit && hit->t == 4 && !miss ? 0 : 1;
}
