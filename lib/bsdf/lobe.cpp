#include "bsdf/lobe.h"

#include <algorithm>
#include <bit>
#include <iterator>

#include "bsdf/bent_normal.h"

namespace limn::bsdf {

namespace {

template <class Function>
void for_each_tangent_facet(const Vertices& v, const Function& function) {
    for (std::uint32_t rest = v.tangent_facets; rest != 0; rest &= rest - 1)
        function(static_cast<std::size_t>(std::countr_zero(rest)));
}

// Makes the bent normals the geometric normals, which lobes need.
void bend(Vertices& v) {
    for_each_tangent_facet(v, [&](std::size_t i) { v.normal.set(i, v.shading_normal.get<Vec3>(i)); });
}

// Sets the values for the directions `in`, including the light that tangent facets mirror. `surface` are the normals
// before they were bent.
void set_values(const Lobe& lobe, Vertices& v, const Rows3& in, const Rows3& surface) {
    // Find the values for the mirrored directions.
    Rows3 mirrored = in;
    for_each_tangent_facet(
        v, [&](std::size_t i) { mirrored.set(i, mirrored_at(surface.get<Normal3>(i), in.get<Vec3>(i))); });
    lobe.value(v, mirrored);
    const Rows3 mirrored_value = v.value;
    Row mirrored_pdf;
    std::copy(std::begin(v.value_pdf), std::end(v.value_pdf), mirrored_pdf);

    // Add them to the values for the directions themselves. No light leaves below the surface.
    lobe.value(v, in);
    for_each_tangent_facet(v, [&](std::size_t i) {
        const bool below = is_below(surface.get<Normal3>(i), in.get<Vec3>(i));
        v.value.set(i, below ? Color{} : v.value.get<Color>(i) + mirrored_value.get<Color>(i));
        v.value_pdf[i] = below ? 0 : v.value_pdf[i] + mirrored_pdf[i];
    });
}

}  // namespace

void value(const Lobe& lobe, Vertices& v, const Rows3& in) {
    if (v.tangent_facets == 0) return lobe.value(v, in);
    const Rows3 surface = v.normal;
    bend(v);
    set_values(lobe, v, in, surface);
    v.normal = surface;
}

void sample(const Lobe& lobe, Vertices& v) {
    if (v.tangent_facets == 0) return lobe.sample(v);
    const Rows3 surface = v.normal;
    bend(v);
    lobe.sample(v);
    // Mirror directions below the surface.
    for_each_tangent_facet(v, [&](std::size_t i) {
        const Normal3 n = surface.get<Normal3>(i);
        const Vec3 in = v.direction.get<Vec3>(i);
        if (is_below(n, in)) v.direction.set(i, mirrored_at(n, in));
    });
    set_values(lobe, v, v.direction, surface);
    v.normal = surface;
    // Weigh the directions by both ways in which they can be drawn.
    for_each_tangent_facet(v, [&](std::size_t i) {
        if (v.pdf[i] == 0 || is_black(v.weight.get<Color>(i))) return;  // specular, or absorbed
        if (!(v.value_pdf[i] > 0)) return v.weight.set(i, Color{});     // along the surface, by rounding
        v.pdf[i] = v.value_pdf[i];
        v.weight.set(i, v.value.get<Color>(i) / v.pdf[i]);
    });
}

}  // namespace limn::bsdf
