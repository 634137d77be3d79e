// The types and functions that formulas of lobes use. The source of a material has, in its namespace per target,
//
//     template <class N>
//     using Input = LobeInput<N, Parameters>;  // Parameters: the struct of the material, or nothing if it has none
//
//     struct Formulas {
//         template <class N> static LobeSample<N> sample(const Input<N>& s, const Vector<N>& random);
//         template <class N> static LobeValue<N> value(const Input<N>& s, const Vector<N>& in);
//     };
//     LIMN_LOBE_STAGES(Formulas)
//
// and LIMN_LOBE once, in the namespace limn. N is one double, or a vector of doubles with one vertex in each
// lane. The include guard is per target, as Highway requires.
#if defined(LIMN_BSDF_LOBE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_BSDF_LOBE_INL_H
#undef LIMN_BSDF_LOBE_INL_H
#else
#define LIMN_BSDF_LOBE_INL_H
#endif

#include <optional>
#include <type_traits>
#include <utility>

#include "bsdf/lobe.h"
#include "math/rows-inl.h"
#include "math/warps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::bsdf::HWY_NAMESPACE {

using namespace sampling::HWY_NAMESPACE;

// The parameters of a lobe that has none.
template <class N>
struct NoParameters {};

// The input of a lobe. It has the fields of Vertices, but the unit direction `out` towards the viewer in place of
// `incoming`, and the parameters by name.
template <class N, template <class> class ParametersOf = NoParameters>
struct LobeInput {
    using Number = N;
    using Parameters = ParametersOf<N>;
    using Table = std::conditional_t<std::is_same_v<N, double>, const AlbedoTable*, const AlbedoTable* const*>;
    static constexpr std::size_t kParameters = sizeof(Parameters) / sizeof(N);  // their number

    Vector<N> normal, shading_normal, out, albedo;
    Mask<N> front_face;
    Parameters parameters;
    // Set only if Lobe::microfacets is true.
    Vector<N> dp_du, factors;
    Table albedo_table, coat_albedo_table;
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

// Returns `weight` where the light is scattered, and black where it is absorbed.
template <class N>
HWY_INLINE Vector<N> weight_where(Mask<N> scatters, const Vector<N>& weight) {
    return select(scatters, weight, {0.0, 0.0, 0.0});
}

template <class N>
HWY_INLINE N mean_of(const Vector<N>& color) {
    return (color.x + color.y + color.z) / 3.0;
}

// Returns the mirror image of `out` about `normal`. It is of unit length if both are.
template <class N>
HWY_INLINE Vector<N> mirror(const Vector<N>& out, const Vector<N>& normal) {
    return (2.0 * dot(out, normal)) * normal - out;
}

// ---- many vertices -------------------------------------------------------------------------------------------------

template <class Input, std::size_t... k>
HWY_INLINE typename Input::Parameters parameters_at(const Vertices& v, std::size_t i, std::index_sequence<k...>) {
    return {load<Doubles>(v.parameters[k] + i)...};
}

// Returns the input for the vertices from i on, one in each lane.
template <class Input>
HWY_INLINE Input input_at(const Vertices& v, std::size_t i) {
    return {.normal = load3<Doubles>(v.normal, i),
            .shading_normal = load3<Doubles>(v.shading_normal, i),
            .out = -normalize(load3<Doubles>(v.incoming, i)),
            .albedo = load3<Doubles>(v.albedo, i),
            .front_face = load<Doubles>(v.front_face + i) > 0.0,
            .parameters = parameters_at<Input>(v, i, std::make_index_sequence<Input::kParameters>()),
            .dp_du = load3<Doubles>(v.dp_du, i),
            .factors = load3<Doubles>(v.factors, i),
            .albedo_table = v.albedo_table + i,
            .coat_albedo_table = v.coat_albedo_table + i};
}

template <class Formulas, class Input>
HWY_INLINE void sample_all(Vertices& v) {
    for (std::size_t i = 0; i < v.count; i += kLanes<Doubles>) {
        const Vector<Doubles> random{load<Doubles>(v.numbers[0] + i), load<Doubles>(v.numbers[1] + i),
                                     load<Doubles>(v.numbers[2] + i)};
        const LobeSample<Doubles> s = Formulas::sample(input_at<Input>(v, i), random);
        store3(s.direction, v.direction, i);
        store3(s.weight, v.weight, i);
        store(s.pdf, v.pdf + i);
    }
}

template <class Formulas, class Input>
HWY_INLINE void value_all(Vertices& v, const Rows3& in) {
    for (std::size_t i = 0; i < v.count; i += kLanes<Doubles>) {
        const LobeValue<Doubles> f = Formulas::value(input_at<Input>(v, i), load3<Doubles>(in, i));
        store3(f.value, v.value, i);
        store(f.pdf, v.value_pdf + i);
    }
}

// ---- one vertex ----------------------------------------------------------------------------------------------------

// Returns the input for one vertex. The arguments after `parameters` are for lobes of microfacets.
template <template <class> class ParametersOf = NoParameters>
LobeInput<double, ParametersOf> input_of(const Surface& s, const Vec3& out, const Color& albedo,
                                         const ParametersOf<double>& parameters = {},
                                         const AlbedoTable* albedo_table = nullptr, const Color& factors = {1, 1, 1},
                                         const AlbedoTable* coat_albedo_table = nullptr) {
    return {.normal = broadcast<double>(s.normal),
            .shading_normal = broadcast<double>(s.shading_normal),
            .out = broadcast<double>(out),
            .albedo = {albedo.r, albedo.g, albedo.b},
            .front_face = s.front_face,
            .parameters = parameters,
            .dp_du = broadcast<double>(s.dp_du),
            .factors = {factors.r, factors.g, factors.b},
            .albedo_table = albedo_table,
            .coat_albedo_table = coat_albedo_table};
}

template <class Formulas, class Input>
std::optional<ScatterSample> sample_one(const Input& input, const Random3& random) {
    const LobeSample<double> s = Formulas::sample(input, broadcast<double>(random));
    const Color weight{s.weight.x, s.weight.y, s.weight.z};
    if (is_black(weight)) return std::nullopt;
    return ScatterSample{.direction = {s.direction.x, s.direction.y, s.direction.z}, .weight = weight, .pdf = s.pdf};
}

template <class Formulas, class Input>
ScatterValue value_one(const Input& input, const Vec3& in) {
    const LobeValue<double> f = Formulas::value(input, broadcast<double>(in));
    return {.value = {f.value.x, f.value.y, f.value.z}, .pdf = f.pdf};
}

}  // namespace limn::bsdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

// Defines the functions of a lobe for one target.
#undef LIMN_LOBE_STAGES
#define LIMN_LOBE_STAGES(Formulas)                                                                   \
    void sample(bsdf::Vertices& v) { bsdf::HWY_NAMESPACE::sample_all<Formulas, Input<Doubles>>(v); } \
    void value(bsdf::Vertices& v, const bsdf::Rows3& in) {                                           \
        bsdf::HWY_NAMESPACE::value_all<Formulas, Input<Doubles>>(v, in);                             \
    }

// Defines name::kLobe, the lobe of a material, and `formulas`, the namespace of its formulas for one vertex. The
// arguments after `name` are the fields of Lobe before `parameters`.
#undef LIMN_LOBE
#define LIMN_LOBE(name, ...)                                                                         \
    namespace name {                                                                                 \
    HWY_EXPORT(sample);                                                                              \
    HWY_EXPORT(value);                                                                               \
    constexpr bsdf::Lobe kLobe{__VA_ARGS__, .parameters = HWY_NAMESPACE::Input<double>::kParameters, \
                               .sample =                                                             \
                                   [](bsdf::Vertices& v) {                                           \
                                       HWY_DYNAMIC_DISPATCH(sample)                                  \
                                       (v);                                                          \
                                   },                                                                \
                               .value =                                                              \
                                   [](bsdf::Vertices& v, const bsdf::Rows3& in) {                    \
                                       HWY_DYNAMIC_DISPATCH(value)                                   \
                                       (v, in);                                                      \
                                   }};                                                               \
    }                                                                                                \
    namespace formulas = name::HWY_NAMESPACE;

#endif
