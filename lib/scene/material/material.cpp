#include "limn/scene/material/material.h"

#include "bsdf/lobe.h"

namespace limn {

namespace {

constexpr MaterialThunks kVirtualCalls{
    .emitted = [](const Material& material, const Surface& s) { return material.emitted(s); },
    .sample = [](const Material& material, const Surface& s, const Vec3& out,
                 const Random3& random) { return material.sample(s, out, random); },
    .value = [](const Material& material, const Surface& s, const Vec3& out,
                const Vec3& in) { return material.value(s, out, in); }};

}  // namespace

MaterialRecord Material::lower(RecordSink& sink) const {
    sink.identify(dynamic_cast<const Tagged*>(this));
    return {.kind = kUserDefinedMaterial,
            .lobe = &bsdf::kUserDefined,
            .uses_tangents = true,
            .object = this,
            .thunks = &kVirtualCalls};
}

MaterialId lower_material(RecordSink& sink, const std::shared_ptr<const Material>& material) {
    return sink.material(material, [&] { return material->lower(sink); });
}

MaterialRef material_ref(const Material* material) {
    if (!material) return {};
    return {.id = MaterialRef::kObject, .object = material, .thunks = &kVirtualCalls};
}

}  // namespace limn
