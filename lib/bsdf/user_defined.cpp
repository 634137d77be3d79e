#include "bsdf/lobe.h"

namespace limn::bsdf {

namespace {

void sample(Vertices& v) {
    for (std::size_t i = 0; i < v.count; ++i) {
        const auto& [surface, object, thunks] = v.user_defined[i];
        const Vec3 out = -normalize(v.incoming.get<Vec3>(i));
        const Random3 random{v.numbers[0][i], v.numbers[1][i], v.numbers[2][i]};
        const auto s = thunks->sample(*object, surface, out, random).value_or(ScatterSample{});
        v.direction.set(i, s.direction);
        v.weight.set(i, s.weight);
        v.pdf[i] = s.pdf;
    }
}

void value(Vertices& v, const Rows3& in) {
    for (std::size_t i = 0; i < v.count; ++i) {
        const auto& [surface, object, thunks] = v.user_defined[i];
        const Vec3 out = -normalize(v.incoming.get<Vec3>(i));
        const ScatterValue f = thunks->value(*object, surface, out, in.get<Vec3>(i));
        v.value.set(i, f.value);
        v.value_pdf[i] = f.pdf;
    }
}

}  // namespace

const Lobe kUserDefined{.one_sided = false, .numbers = 3, .sample = sample, .value = value};

}  // namespace limn::bsdf
