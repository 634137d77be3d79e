#include "limn/scene/texture/perlin.h"

#include <cmath>
#include <utility>

#include "bsdf/perlin.h"
#include "math/require.h"

namespace limn {

namespace {

std::shared_ptr<const PerlinLattice> lattice_of(std::uint64_t seed) {
    return std::make_shared<const PerlinLattice>(PerlinLattice::from_seed(seed));
}

// Throws ArgumentError if an argument of a noise texture is invalid.
void check(const std::string& texture, double scale, const std::shared_ptr<const PerlinLattice>& lattice,
           const Color& color) {
    require(std::isfinite(scale), texture + ": scale must be finite");
    require(lattice != nullptr, texture + ": lattice must not be null");
    require(is_radiance(color), texture + ": color must be finite and not negative");
}

TextureRecord record_of(TextureKind kind, RecordSink& sink, double scale,
                        const std::shared_ptr<const PerlinLattice>& lattice, const Color& color) {
    TextureRecord record;
    record.kind = kind;
    record.data = sink.lattice(lattice);
    record.scale = scale;
    record.color = color;
    return record;
}

}  // namespace

Noise::Noise(double scale, std::uint64_t seed, const Color& color) : Noise(scale, lattice_of(seed), color) {}

Noise::Noise(double scale, std::shared_ptr<const PerlinLattice> lattice, const Color& color)
    : scale_(scale), lattice_(std::move(lattice)), color_(color) {
    check("Noise", scale_, lattice_, color_);
}

Color Noise::value(const Surface& s) const { return color_ * pattern::noise_factor(*lattice_, scale_, s.position); }

TextureRecord Noise::lower(RecordSink& sink) const {
    return record_of(TextureKind::noise, sink, scale_, lattice_, color_);
}

Turbulence::Turbulence(double scale, std::uint64_t seed, const Color& color)
    : Turbulence(scale, lattice_of(seed), color) {}

Turbulence::Turbulence(double scale, std::shared_ptr<const PerlinLattice> lattice, const Color& color)
    : scale_(scale), lattice_(std::move(lattice)), color_(color) {
    check("Turbulence", scale_, lattice_, color_);
}

Color Turbulence::value(const Surface& s) const {
    return color_ * pattern::turbulence_factor(*lattice_, scale_, s.position);
}

TextureRecord Turbulence::lower(RecordSink& sink) const {
    return record_of(TextureKind::turbulence, sink, scale_, lattice_, color_);
}

Marble::Marble(double scale, std::uint64_t seed, const Color& color) : Marble(scale, lattice_of(seed), color) {}

Marble::Marble(double scale, std::shared_ptr<const PerlinLattice> lattice, const Color& color)
    : scale_(scale), lattice_(std::move(lattice)), color_(color) {
    check("Marble", scale_, lattice_, color_);
}

Color Marble::value(const Surface& s) const { return color_ * pattern::marble(*lattice_, scale_, s.position); }

TextureRecord Marble::lower(RecordSink& sink) const {
    return record_of(TextureKind::marble, sink, scale_, lattice_, color_);
}

}  // namespace limn
