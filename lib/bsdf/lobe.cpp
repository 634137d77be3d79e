#include "bsdf/lobe.h"

#include <algorithm>
#include <bit>
#include <iterator>

#include "bsdf/bent_normal.h"
#include "limn/records/records.h"

namespace limn::bsdf {

namespace {

template <class Function>
void for_each_fold(const Vertices& v, const Function& function) {
    for (std::uint32_t rest = v.folds; rest != 0; rest &= rest - 1)
        function(static_cast<std::size_t>(std::countr_zero(rest)));
}

// As seen by lobes: the bent normals are those of the surface.
void bend(Vertices& v) {
    for_each_fold(v, [&](std::size_t i) { v.normal.set(i, v.shading_normal.get<Vec3>(i)); });
}

void add_folded(const Lobe& lobe, Vertices& v, const Rows3& in, const Rows3& surface) {
    Rows3 mirrored = in;
    for_each_fold(v, [&](std::size_t i) { mirrored.set(i, mirrored_at(surface.get<Normal3>(i), in.get<Vec3>(i))); });
    lobe.value(v, mirrored);
    const Rows3 value = v.value;
    Row pdf;
    std::copy(std::begin(v.value_pdf), std::end(v.value_pdf), pdf);
    lobe.value(v, in);
    for_each_fold(v, [&](std::size_t i) {
        const bool below = is_below(surface.get<Normal3>(i), in.get<Vec3>(i));
        v.value.set(i, below ? Color{} : v.value.get<Color>(i) + value.get<Color>(i));
        v.value_pdf[i] = below ? 0 : v.value_pdf[i] + pdf[i];
    });
}

}  // namespace

void value(const Lobe& lobe, Vertices& v, const Rows3& in) {
    if (v.folds == 0) return lobe.value(v, in);
    const Rows3 surface = v.normal;
    bend(v);
    add_folded(lobe, v, in, surface);
    v.normal = surface;
}

void sample(const Lobe& lobe, Vertices& v) {
    if (v.folds == 0) return lobe.sample(v);
    const Rows3 surface = v.normal;
    bend(v);
    lobe.sample(v);
    for_each_fold(v, [&](std::size_t i) {
        const Normal3 n = surface.get<Normal3>(i);
        const Vec3 in = v.direction.get<Vec3>(i);
        if (is_below(n, in)) v.direction.set(i, mirrored_at(n, in));
    });
    add_folded(lobe, v, v.direction, surface);
    v.normal = surface;
    for_each_fold(v, [&](std::size_t i) {
        if (v.pdf[i] == 0 || is_black(v.weight.get<Color>(i))) return;  // specular, or absorbed
        if (!(v.value_pdf[i] > 0)) return v.weight.set(i, Color{});     // along the surface, by rounding
        v.pdf[i] = v.value_pdf[i];
        v.weight.set(i, v.value.get<Color>(i) / v.pdf[i]);
    });
}

}  // namespace limn::bsdf
