// What a material's formulas are written in, over the kind of number N: a struct with
//
//     template <class N> static LobeSample<N> sample(const LobeInput<N>&, const Vector<N>& random)
//     template <class N> static LobeValue<N> value(const LobeInput<N>&, const Vector<N>& in)
//
// Per-target include guard, as Highway has it.
#if defined(LIMN_BSDF_LOBE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_BSDF_LOBE_INL_H
#undef LIMN_BSDF_LOBE_INL_H
#else
#define LIMN_BSDF_LOBE_INL_H
#endif

#include <optional>
#include <type_traits>

#include "bsdf/lobe.h"
#include "math/rows-inl.h"
#include "math/warps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::bsdf::HWY_NAMESPACE {

using namespace sampling::HWY_NAMESPACE;

// As in Vertices.
template <class N>
struct LobeInput {
    Vector<N> normal, shading_normal, out, albedo;
    Mask<N> front_face, exact_fresnel;
    N parameter;
    // Of materials with details.
    Vector<N> dp_du, second_texture;
    N details[MaterialDetails::kNumbers];
    std::conditional_t<std::is_same_v<N, double>, const AlbedoTable*, const AlbedoTable*const*> albedo_table,
        coat_albedo_table;
};

template <class N>
struct LobeSample {
    Vector<N> direction, weight;
    N pdf;
};

template <class N>
struct LobeValue {
    Vector<N> value;
    N pdf;
};

// Black where the light is absorbed.
template <class N>
HWY_INLINE Vector<N> weight_where(Mask<N> scatters, const Vector<N>& weight) {
    return select(scatters, weight, {0.0, 0.0, 0.0});
}

template <class N>
HWY_INLINE N mean_of(const Vector<N>& color) {
    return (color.x + color.y + color.z) / 3.0;
}

// The mirror image of `out` about `normal`; unit if both are.
template <class N>
HWY_INLINE Vector<N> mirror(const Vector<N>& out, const Vector<N>& normal) {
    return (2.0 * dot(out, normal)) * normal - out;
}

HWY_INLINE LobeInput<Doubles> input_at(const Vertices& v, std::size_t i) {
    LobeInput<Doubles> input{load3<Doubles>(v.normal, i),
                             load3<Doubles>(v.shading_normal, i),
                             -normalize(load3<Doubles>(v.incoming, i)),
                             load3<Doubles>(v.albedo, i),
                             load<Doubles>(v.front_face + i) > 0.0,
                             load<Doubles>(v.exact_fresnel + i) > 0.0,
                             load<Doubles>(v.parameter + i),
                             load3<Doubles>(v.dp_du, i),
                             load3<Doubles>(v.second_texture, i),
                             {},
                             v.albedo_table + i,
                             v.coat_albedo_table + i};
    for (std::size_t k = 0; k < MaterialDetails::kNumbers; ++k) input.details[k] = load<Doubles>(v.details[k] + i);
    return input;
}

template <class L>
HWY_INLINE void sample_all(Vertices& v) {
    for (std::size_t i = 0; i < v.count; i += kLanes<Doubles>) {
        const LobeSample<Doubles> s =
            L::sample(input_at(v, i), Vector<Doubles>{load<Doubles>(v.numbers[0] + i), load<Doubles>(v.numbers[1] + i),
                                                      load<Doubles>(v.numbers[2] + i)});
        store3(s.direction, v.direction, i), store3(s.weight, v.weight, i), store(s.pdf, v.pdf + i);
    }
}

template <class L>
HWY_INLINE void value_all(Vertices& v, const Rows3& in) {
    for (std::size_t i = 0; i < v.count; i += kLanes<Doubles>) {
        const LobeValue<Doubles> f = L::value(input_at(v, i), load3<Doubles>(in, i));
        store3(f.value, v.value, i), store(f.pdf, v.value_pdf + i);
    }
}

// The same for one vertex.
inline LobeInput<double> input_of(const Surface& s, const Vec3& out, const Color& albedo, double parameter = 0,
                                  Fresnel fresnel = Fresnel::exact) {
    return {broadcast<double>(s.normal),
            broadcast<double>(s.shading_normal),
            broadcast<double>(out),
            {albedo.r, albedo.g, albedo.b},
            s.front_face,
            fresnel == Fresnel::exact,
            parameter,
            broadcast<double>(s.dp_du),
            {1, 1, 1},
            {},
            nullptr,
            nullptr};
}

// With details.
inline LobeInput<double> input_of(const Surface& s, const Vec3& out, const Color& albedo, double parameter,
                                  const MaterialDetails& details, const Color& second_texture = {1, 1, 1}) {
    LobeInput<double> input = input_of(s, out, albedo, parameter);
    input.second_texture = {second_texture.r, second_texture.g, second_texture.b};
    for (std::size_t k = 0; k < MaterialDetails::kNumbers; ++k) input.details[k] = details.numbers[k];
    input.albedo_table = details.albedo_table.get();
    input.coat_albedo_table = details.coat_albedo_table.get();
    return input;
}

template <class L>
std::optional<ScatterSample> sample_one(const LobeInput<double>& input, const Random3& random) {
    const LobeSample<double> s = L::sample(input, broadcast<double>(random));
    const Color weight{s.weight.x, s.weight.y, s.weight.z};
    if (is_black(weight)) return std::nullopt;
    return ScatterSample{.direction = {s.direction.x, s.direction.y, s.direction.z}, .weight = weight, .pdf = s.pdf};
}

template <class L>
ScatterValue value_one(const LobeInput<double>& input, const Vec3& in) {
    const LobeValue<double> f = L::value(input, broadcast<double>(in));
    return {.value = {f.value.x, f.value.y, f.value.z}, .pdf = f.pdf};
}

}  // namespace limn::bsdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

// A material's functions for Lobe, where its struct of formulas stands, and, once, its lobe: kLobe.
#undef LIMN_LOBE_STAGES
#define LIMN_LOBE_STAGES(Formulas)                                                   \
    void sample(bsdf::Vertices& v) { bsdf::HWY_NAMESPACE::sample_all<Formulas>(v); } \
    void value(bsdf::Vertices& v, const bsdf::Rows3& in) { bsdf::HWY_NAMESPACE::value_all<Formulas>(v, in); }

#undef LIMN_LOBE
#define LIMN_LOBE(...)                                                                   \
    HWY_EXPORT(sample);                                                                  \
    HWY_EXPORT(value);                                                                   \
    extern constexpr bsdf::Lobe kLobe{__VA_ARGS__,                                       \
                                      .sample =                                          \
                                          [](bsdf::Vertices& v) {                        \
                                              HWY_DYNAMIC_DISPATCH(sample)               \
                                              (v);                                       \
                                          },                                             \
                                      .value =                                           \
                                          [](bsdf::Vertices& v, const bsdf::Rows3& in) { \
                                              HWY_DYNAMIC_DISPATCH(value)                \
                                              (v, in);                                   \
                                          }};

#endif
