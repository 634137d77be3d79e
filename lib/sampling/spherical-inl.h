// Rectangles and triangles as seen from a point: their solid angles, and directions uniform in them. Per-target include
// guard, as Highway has it.
#if defined(LIMN_SAMPLING_SPHERICAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_SAMPLING_SPHERICAL_INL_H
#undef LIMN_SAMPLING_SPHERICAL_INL_H
#else
#define LIMN_SAMPLING_SPHERICAL_INL_H
#endif

#include "lanes/functions-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::sampling::HWY_NAMESPACE {

using namespace limn::HWY_NAMESPACE;

// Weights of two edges.
template <class N>
struct Weights {
    N u, v;
};

// Urena, Fajardo, King, An Area-Preserving Parametrization for Spherical Rectangles, EGSR 2013; symbols as there. Ours:
// its four angles are added as complex numbers, so that there is one arc tangent, and differences that cancel where the
// rectangle is seen almost edge-on are taken of what is left of them.
template <class N>
class SphericalRectangle {
public:
    // \pre the edges are perpendicular
    HWY_INLINE SphericalRectangle(const Vector<N>& corner, const Vector<N>& edge_u, const Vector<N>& edge_v,
                                  const Vector<N>& from) {
        const N length_u = sqrt(length_squared(edge_u)), length_v = sqrt(length_squared(edge_v));
        const Vector<N> x = (1.0 / length_u) * edge_u, y = (1.0 / length_v) * edge_v, z = cross(x, y);
        const Vector<N> d = corner - from;
        x0_ = dot(d, x), y0_ = dot(d, y), z0_ = -abs(dot(d, z));
        x1_ = x0_ + length_u, y1_ = y0_ + length_v;
        const N z2 = z0_ * z0_;
        // Corners and edges over their distance from `from`.
        const N over_x0 = 1.0 / sqrt(x0_ * x0_ + z2), over_x1 = 1.0 / sqrt(x1_ * x1_ + z2);
        over_y0_ = 1.0 / sqrt(y0_ * y0_ + z2), over_y1_ = 1.0 / sqrt(y1_ * y1_ + z2);
        // The inner angle at a corner of the spherical quadrilateral lies between the planes through its two sides.
        // Neither its sine nor its cosine cancels.
        const auto inner = [&](N cx, N cy, N over_x, N over_y, double sign) HWY_ATTR {
            const N over = over_x * over_y;
            return SineCosine<N>{-z0_ * sqrt(cx * cx + cy * cy + z2) * over, sign * (cx * cy) * over};
        };
        const SineCosine<N> g01 = sum(inner(x1_, y0_, over_x1, over_y0_, 1), inner(x1_, y1_, over_x1, over_y1_, -1));
        g23_ = sum(inner(x0_, y1_, over_x0, over_y1_, 1), inner(x0_, y0_, over_x0, over_y0_, -1));
        solid_angle_ = select(z0_ == 0.0, 0.0, angle_of(sum(g01, g23_)));
    }

    // In steradians; 0 where `from` lies in the rectangle's plane.
    N solid_angle() const { return solid_angle_; }

    // A point of the rectangle whose direction from `from` is uniform per solid angle. \pre solid_angle() > 0
    HWY_INLINE Weights<N> sample(N u, N v) const {
        const N z2 = z0_ * z0_;
        // au = u * solid_angle + 2 pi - g2 - g3.
        const SineCosine<N> au =
            sum(sine_cosine_of_turns<N>(u * (solid_angle_ * (1 / (2 * kPi)))), {-g23_.sine, g23_.cosine});
        const N b0 = -y0_ * over_y0_, b1 = y1_ * over_y1_;
        const N q0 = z2 * (over_y0_ * over_y0_), q1 = z2 * (over_y1_ * over_y1_);
        // fu = (cos(au) b0 - b1) / sin(au). Almost edge-on b0 and b1 are 1 but for q0 / 2 and q1 / 2, and so is
        // cos(au), up to signs: cos(au) - 1 is meant where b0 and b1 have the same sign, else cos(au) + 1.
        const N sign = select(copy_sign(1.0, b0) == copy_sign(1.0, b1), -1.0, 1.0);
        const Mask<N> cancels = au.cosine * sign < 0.0;
        const N cosine_less_sign =
            select(cancels, sign * (au.sine * au.sine) / (1.0 - sign * au.cosine), au.cosine + sign);
        const N b_difference = copy_sign(1.0, b1) * (q1 - q0) / (abs(b0) + abs(b1));
        const N fu = (cosine_less_sign * b0 + b_difference) / au.sine;
        const N xu = min(max(copy_sign(-z0_, fu) / sqrt(max(fu * fu - q0, 1e-300)), x0_), x1_);
        const N distance2 = xu * xu + z2;
        const N h0 = y0_ / sqrt(distance2 + y0_ * y0_), h1 = y1_ / sqrt(distance2 + y1_ * y1_);
        const N hv = h0 + v * (h1 - h0), rest = 1.0 - hv * hv;
        const N inward = min(max(hv * sqrt(distance2 / rest), y0_), y1_);
        const N yv = select(rest > 0.0, inward, select(hv < 0.0, y0_, y1_));
        return {(xu - x0_) / (x1_ - x0_), (yv - y0_) / (y1_ - y0_)};
    }

private:
    static HWY_INLINE SineCosine<N> sum(const SineCosine<N>& a, const SineCosine<N>& b) {
        return {a.sine * b.cosine + a.cosine * b.sine, a.cosine * b.cosine - a.sine * b.sine};
    }

    N x0_, x1_, y0_, y1_, z0_;  // corners relative to `from`; the rectangle's plane is z = z0 < 0
    N over_y0_, over_y1_, solid_angle_;
    SineCosine<N> g23_;  // the angle at the two corners of x0
};

// After Arvo, Stratified Sampling of Spherical Triangles, SIGGRAPH 1995, with the solid angle of Van Oosterom and
// Strackee, IEEE Transactions on Biomedical Engineering 30(2), 1983.
template <class N>
class SphericalTriangle {
public:
    // Unit vectors towards the corners, no two of them opposite.
    HWY_INLINE SphericalTriangle(const Vector<N>& a, const Vector<N>& b, const Vector<N>& c)
        : a_(a), b_(b), c_(c), cos_c_(dot(a, b)), volume_(abs(dot(a, cross(b - a, c - a)))) {
        solid_angle_ = 2.0 * angle_of<N>({volume_, 1.0 + cos_c_ + dot(b, c) + dot(c, a)});
    }

    // In steradians; 0 where the corners are on a great circle.
    N solid_angle() const { return solid_angle_; }

    // A unit vector, uniform per solid angle: an arc that turns around b from a to c has passed the share u of it, and
    // v says how far along the arc. A corner moves from a towards c until the triangle that it makes with a and b has
    // the solid angle s = u times the whole; then the direction lies on the arc from b to it. With the corner at p =
    // cos(t) a + sin(t) e, e perpendicular to a, the formula for the solid angle reads
    //     tan(s / 2) = sin(t) |e . (a x b)| / ((1 + a.b) (1 + cos(t)) + sin(t) b.e),
    // which tan(t / 2) = sin(t) / (1 + cos(t)) solves. \pre solid_angle() > 0
    HWY_INLINE Vector<N> sample(N u, N v) const {
        const SineCosine<N> half = sine_cosine_of_turns<N>(u * solid_angle_ * (1 / (4 * kPi)));
        const Vector<N> along = c_ - dot(a_, c_) * a_;  // e, times its length
        const N scale = 1.0 / sqrt(length_squared(along));
        const N rise = half.sine * (1.0 + cos_c_);
        const N run = half.cosine * (volume_ * scale) - half.sine * (dot(b_, along) * scale);
        const N over = 1.0 / (rise * rise + run * run);
        const Vector<N> p = ((run * run - rise * rise) * over) * a_ + (2.0 * rise * run * over * scale) * along;
        // 1 - cos of the angle from b, without the cancellation where they are close.
        const N fall = v * (length_squared(b_ - p) / 2.0);
        const Vector<N> aside = p - dot(b_, p) * b_;
        const N length_aside = sqrt(length_squared(aside));
        const Vector<N> turned = (1.0 - fall) * b_ + (sqrt(max(0.0, fall * (2.0 - fall))) / length_aside) * aside;
        return select(length_aside > 0.0, turned, b_);
    }

private:
    Vector<N> a_, b_, c_;
    N cos_c_;   // of the side from a to b
    N volume_;  // |a . (b x c)|
    N solid_angle_;
};

}  // namespace limn::sampling::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
