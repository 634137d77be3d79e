// The parts that lobes of microfacets share, except for the microsurface itself (microfacet-inl.h). The include guard
// is per target, as Highway requires.
#if defined(LIMN_BSDF_ROUGH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_BSDF_ROUGH_INL_H
#undef LIMN_BSDF_ROUGH_INL_H
#else
#define LIMN_BSDF_ROUGH_INL_H
#endif

#include "bsdf/albedo_table.h"
#include "bsdf/fresnel-inl.h"
#include "bsdf/lobe-inl.h"
#include "bsdf/microfacet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::bsdf::HWY_NAMESPACE {

// The frame of the shading normal. x is along dp_du, or along any tangent if dp_du is zero or parallel to the normal.
template <class N>
struct ShadingFrame {
    Vector<N> x, y, z;
    Vector<N> out;  // direction to the viewer, in this frame

    template <class Input>
    HWY_INLINE explicit ShadingFrame(const Input& s) : z(s.shading_normal) {
        const Vector<N> along = s.dp_du - dot(s.dp_du, z) * z;
        const N squared = length_squared(along);
        // Cancellation leaves an error of 2^-52 |dp_du| in `along`: relative to its length at most 1e-9.
        const Mask<N> is_tangent = squared > 1e-12 * length_squared(s.dp_du);
        x = select(is_tangent, along / sqrt(squared), Basis<N>(z).x);
        y = cross(z, x);
        // An interpolated normal may face away from the viewer. The surface then looks as it does at the horizon, which
        // is the least cosine of the albedo tables.
        out = to_local(s.out);
        out.z = max(out.z, 1e-4);
        out = normalize(out);
    }
    HWY_INLINE Vector<N> to_local(const Vector<N>& w) const { return {dot(w, x), dot(w, y), dot(w, z)}; }
    HWY_INLINE Vector<N> to_world(const Vector<N>& w) const { return w.x * x + w.y * y + w.z * z; }
};

// These return the albedo for a cosine, and the mean albedo of a row. \param row see AlbedoTable
HWY_INLINE double albedo_at(const AlbedoTable* table, double row, double cosine) { return table->at(row, cosine); }
HWY_INLINE double mean_albedo(const AlbedoTable* table, double row) { return table->mean_at(row); }

// The same for vectors. A lane without a table gets 0.
template <class D, class Function>
HWY_INLINE Wide<D> of_each_lane(Wide<D> a, Wide<D> b, const Function& function) {
    HWY_ALIGN double first[hn::MaxLanes(D())], second[hn::MaxLanes(D())], result[hn::MaxLanes(D())];
    store(a, first);
    store(b, second);
    for (std::size_t i = 0; i < hn::MaxLanes(D()); ++i) result[i] = function(i, first[i], second[i]);
    return load<Wide<D>>(result);
}
template <class D>
HWY_INLINE Wide<D> albedo_at(const AlbedoTable* const* tables, Wide<D> row, Wide<D> cosine) {
    return of_each_lane(row, cosine,
                        [&](std::size_t i, double r, double c) { return tables[i] ? tables[i]->at(r, c) : 0; });
}
template <class D>
HWY_INLINE Wide<D> mean_albedo(const AlbedoTable* const* tables, Wide<D> row) {
    return of_each_lane(row, row,
                        [&](std::size_t i, double r, double) { return tables[i] ? tables[i]->mean_at(r) : 0; });
}

// Returns f |cos| of light that isn't scattered once: (1 - E(out)) (1 - E(in)) / (1 - mean E) cos / pi, where E is the
// albedo. It is either scattered among facets more than once (Kulla and Conty, Revisiting Physically Based Shading at
// Imageworks, 2017), or by a white base under a coat (Kelemen and Szirmay-Kalos, A Microfacet Based Coupled
// Specular-Matte BRDF Model with Importance Sampling, Eurographics 2001).
// \param missing_out,missing_in 1 - E for either direction
// If almost all light is scattered once, 1 - mean E may be rounded to 0 or below. It is then taken to be 1e-15, a few
// units in the last place of E.
template <class N>
HWY_INLINE N spread_evenly(N missing_out, N missing_in, N mean_albedo, N cosine_pdf) {
    return missing_out * missing_in / max(1.0 - mean_albedo, 1e-15) * cosine_pdf;
}
// Returns the factor of that light for facets of mean reflectance `mean`. Every further scattering reflects the share
// `mean` of the light that hasn't left (Hill, A Multifaceted Exploration, part 4, 2018).
template <class N>
HWY_INLINE N reflected_often(N mean, N mean_albedo) {
    return mean * mean * mean_albedo / (1.0 - mean * (1.0 - mean_albedo));
}

// A vertex on microfacets. The lobe has the parameters alpha_x and alpha_y. Both are 0 if the surface is smooth.
template <class Input>
struct Facets {
    using N = typename Input::Number;

    const Input& s;
    Mask<N> smooth;
    Microsurface<N> surface;
    ShadingFrame<N> frame;

    HWY_INLINE explicit Facets(const Input& input)
        : s(input),
          smooth(s.parameters.alpha_x == 0.0),
          surface{select(smooth, 1.0, s.parameters.alpha_x), select(smooth, 1.0, s.parameters.alpha_y)},
          frame(s) {}

    // Returns the row of the albedo table for a direction. The rows of a brushed surface are azimuths between the axes.
    HWY_INLINE N row_of(const Vector<N>& w) const {
        if (!any(s.parameters.alpha_x != s.parameters.alpha_y)) return 0.0;
        return angle_of<N>({abs(w.y), max(abs(w.x), 1e-12)}) / (kPi / 2);  // 0 for the normal, which has no azimuth
    }
    HWY_INLINE N albedo(const Vector<N>& w) const {
        return albedo_at(s.albedo_table, row_of(w), min(max(w.z, 0.0), 1.0));
    }
    HWY_INLINE N mean_albedo() const { return bsdf::HWY_NAMESPACE::mean_albedo(s.albedo_table, N(0.0)); }
};

}  // namespace limn::bsdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
