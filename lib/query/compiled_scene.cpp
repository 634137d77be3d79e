#include "limn/query/compiled_scene.h"

#include "flat/compile.h"
#include "math/parallel.h"
#include "query/ask.h"
#include "query/surface_at.h"
#include "shading/albedo.h"
#include "shading/shading.h"

namespace limn {

using query::ask;

namespace {

SceneStats stats_of(const flat::Scene& s) {
    return {.memory_bytes = s.memory_bytes,
            .primitives = s.primitives,
            .stored_primitives = s.stored_primitives,
            .degenerate = s.degenerate,
            .lights = s.lights.size() + s.lights.distant.size(),
            .seconds = s.compile_seconds};
}

}  // namespace

CompiledScene::CompiledScene(std::unique_ptr<flat::Scene> scene)
    : scene_(std::move(scene)), stats_(stats_of(*scene_)) {}
CompiledScene::CompiledScene(CompiledScene&&) noexcept = default;
CompiledScene& CompiledScene::operator=(CompiledScene&&) noexcept = default;
CompiledScene::~CompiledScene() = default;

Surface CompiledScene::surface_at(const Ray& ray, const RayHit& hit) const {
    return ask(*this, [&](const flat::Scene& scene) {
        return query::surface_at(scene, ray, {{hit.t, hit.primitive}, hit.u, hit.v}).surface;
    });
}

Color CompiledScene::albedo(const Surface& surface) const {
    return ask(*this, [&](const flat::Scene& scene) { return shade::albedo(scene, surface); });
}

Color CompiledScene::emission(const Surface& surface) const {
    return ask(*this, [&](const flat::Scene& scene) {
        return shade::can_emit(scene, surface.material) ? shade::emitted(scene, surface) : Color{};
    });
}

std::string_view CompiledScene::material_name(const RayHit& hit) const {
    const auto& names = scene_->material_names[hit.object];
    const flat::Place place = flat::locate(*scene_, hit.primitive);
    const PrimitiveRange& range = scene_->ranges[place.range];
    if (!names || range.kind != PrimitiveKind::mesh) return {};
    const std::span slots = scene_->meshes[range.first_row].arrays.material_slots;
    const std::size_t slot = slots.empty() ? 0 : slots[place.element];
    return slot == 0 || slot > names->size() ? std::string_view{} : (*names)[slot - 1];
}

const std::string& CompiledScene::features() const { return scene_->feature_names; }
const std::string& CompiledScene::name() const { return scene_->name; }
const Hash128& CompiledScene::digest() const { return scene_->digest; }
bool CompiledScene::has_untagged() const { return scene_->untagged; }

CompiledScene compile(const Scene& scene) {
    return CompiledScene(with_threads(0, [&] { return std::make_unique<flat::Scene>(compiler::flatten(scene)); }));
}

CompiledScene recompile(CompiledScene&& scene, std::span<const MovedObject> moved) {
    with_threads(0, [&] { compiler::move(*scene.scene_, moved); });
    return CompiledScene(std::move(scene.scene_));
}

}  // namespace limn
