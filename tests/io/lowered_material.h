// What a model's material lowers to.
#pragma once

#include "limn/image/image.h"
#include "limn/records/record_sink.h"
#include "limn/scene/material/material.h"
#include "limn/scene/model.h"

namespace limn::test {

struct LoweredMaterial {
    // The first one that a file names.
    explicit LoweredMaterial(const Model& model) : LoweredMaterial(*model.meshes.at(0)->materials().at(1)) {}
    explicit LoweredMaterial(const Material& material) : record(material.lower(sink)) {}

    const TextureRecord& texture(TextureId id) const {
        return sink.records().textures.at(static_cast<std::uint32_t>(id));
    }
    // A texture's value, of the nearest texel.
    Color at(TextureId id, double u, double v) const {
        const TextureRecord& t = texture(id);
        if (t.kind == TextureKind::solid) return t.color;
        const Image& image = *sink.records().images.at(t.data);
        return image.at(static_cast<int>(u * image.width()), static_cast<int>((1 - v) * image.height()));
    }
    Color color() const { return at(record.emission != TextureId::none ? record.emission : record.albedo, 0.5, 0.5); }
    double opacity(double u = 0.5) const {
        return record.opacity == TextureId::none ? 1 : at(record.opacity, u, 0.5).r;
    }

    RecordSink sink;
    MaterialRecord record;
};

}  // namespace limn::test
