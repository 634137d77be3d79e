#include "limn/math/warp.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "math/warps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn {

namespace inl = sampling::HWY_NAMESPACE;

namespace {

Vec3 vec3(const HWY_NAMESPACE::Vector<double>& v) { return {v.x, v.y, v.z}; }

}  // namespace

Vec3 sample_cosine_hemisphere(double u, double v) { return vec3(inl::cosine_hemisphere(u, v)); }

double pdf_cosine_hemisphere(double cos_theta) { return inl::cosine_hemisphere_pdf(std::max(0.0, cos_theta)); }

Vec3 sample_uniform_sphere(double u, double v) { return vec3(inl::uniform_sphere(u, v)); }

double pdf_uniform_sphere() { return inl::uniform_sphere_pdf<double>(); }

Vec3 sample_uniform_disc(double u, double v) { return vec3(inl::uniform_disc(u, v)); }

Vec3 sample_uniform_ball(double u, double v, double w) { return vec3(inl::uniform_ball(u, v, w)); }

Vec3 sample_uniform_cone(double u, double v, double one_minus_cos_max) {
    return vec3(inl::uniform_cone(u, v, one_minus_cos_max));
}

double pdf_uniform_cone(double one_minus_cos_max) { return inl::uniform_cone_pdf(one_minus_cos_max); }

Uv sample_uniform_triangle(double u, double v) { return v > u ? Uv{u / 2, v - u / 2} : Uv{u - v / 2, v / 2}; }

double sample_exponential(double u, double sigma) { return sigma > 0 ? -logarithm_of_1_plus(-u) / sigma : kInfinity; }

double pdf_exponential(double distance, double sigma) {
    return distance >= 0 ? sigma * exponential(-sigma * distance) : 0;
}

}  // namespace limn
HWY_AFTER_NAMESPACE();
