// Rectangles and triangles as seen from a point: their solid angles, and samples that are uniform per solid angle. The
// include guard is per target, as Highway requires.
#if defined(LIMN_MATH_SPHERICAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_MATH_SPHERICAL_INL_H
#undef LIMN_MATH_SPHERICAL_INL_H
#else
#define LIMN_MATH_SPHERICAL_INL_H
#endif

#include "math/functions-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limn::sampling::HWY_NAMESPACE {

using namespace limn::HWY_NAMESPACE;

// A point of a rectangle: corner + u edge_u + v edge_v.
template <class N>
struct Weights {
    N u, v;
};

// A rectangle seen from a point. The method and the symbols are those of Urena, Fajardo, King, An Area-Preserving
// Parametrization for Spherical Rectangles, EGSR 2013. There are two changes:
//   - The four inner angles are added as complex numbers, which takes one arc tangent instead of four.
//   - Differences that would cancel if the rectangle is seen almost edge-on are rewritten in terms that do not cancel.
template <class N>
class SphericalRectangle {
public:
    // \pre the edges are perpendicular
    HWY_INLINE SphericalRectangle(const Vector<N>& corner, const Vector<N>& edge_u, const Vector<N>& edge_v,
                                  const Vector<N>& from) {
        // Find the local frame, and the corners in it relative to `from`.
        const N length_u = sqrt(length_squared(edge_u)), length_v = sqrt(length_squared(edge_v));
        const Vector<N> x = (1.0 / length_u) * edge_u, y = (1.0 / length_v) * edge_v, z = cross(x, y);
        const Vector<N> d = corner - from;
        x0_ = dot(d, x);
        y0_ = dot(d, y);
        z0_ = -abs(dot(d, z));
        x1_ = x0_ + length_u;
        y1_ = y0_ + length_v;
        const N z2 = z0_ * z0_;
        // Compute the reciprocal distances of the lines of the four edges from `from`.
        const N over_x0 = 1.0 / sqrt(x0_ * x0_ + z2), over_x1 = 1.0 / sqrt(x1_ * x1_ + z2);
        over_y0_ = 1.0 / sqrt(y0_ * y0_ + z2);
        over_y1_ = 1.0 / sqrt(y1_ * y1_ + z2);
        // Compute the inner angles of the spherical quadrilateral. The angle at a corner is that between the planes
        // through `from` and the two edges. Neither its sine nor its cosine cancels.
        const auto inner = [&](N cx, N cy, N over_x, N over_y, double sign) HWY_ATTR {
            const N over = over_x * over_y;
            return SineCosine<N>{-z0_ * sqrt(cx * cx + cy * cy + z2) * over, sign * (cx * cy) * over};
        };
        // Add the angles. The solid angle is their sum minus 2 pi.
        const SineCosine<N> g01 = sum(inner(x1_, y0_, over_x1, over_y0_, 1), inner(x1_, y1_, over_x1, over_y1_, -1));
        g23_ = sum(inner(x0_, y1_, over_x0, over_y1_, 1), inner(x0_, y0_, over_x0, over_y0_, -1));
        solid_angle_ = select(z0_ == 0.0, 0.0, angle_of(sum(g01, g23_)));
    }

    // Returns the solid angle in steradians. It is 0 if `from` is in the rectangle's plane.
    N solid_angle() const { return solid_angle_; }

    // Returns a point of the rectangle whose direction from `from` is uniform: its pdf is 1 / solid_angle() per solid
    // angle. \pre solid_angle() > 0
    HWY_INLINE Weights<N> sample(N u, N v) const {
        const N z2 = z0_ * z0_;
        // Compute au = u * solid_angle + 2 pi - g2 - g3.
        const SineCosine<N> au =
            sum(sine_cosine_of_turns<N>(u * (solid_angle_ * (1 / (2 * kPi)))), {-g23_.sine, g23_.cosine});
        const N b0 = -y0_ * over_y0_, b1 = y1_ * over_y1_;
        const N q0 = z2 * (over_y0_ * over_y0_), q1 = z2 * (over_y1_ * over_y1_);
        // Compute fu = (cos(au) b0 - b1) / sin(au). If the rectangle is seen almost edge-on, then |b0|, |b1| and
        // |cos(au)| are almost 1, and the numerator would cancel. Therefore let sign be -1 if b0 and b1 have the same
        // sign, else 1, and write the numerator as (cos(au) + sign) b0 - (sign b0 + b1). Its two parts do not cancel if
        // written as
        //     cos(au) + sign = sign sin(au)^2 / (1 - sign cos(au)),
        //     -(sign b0 + b1) = s (|b0| - |b1|) = s (q1 - q0) / (|b0| + |b1|), where s is the sign of b1.
        // The last step holds because b0^2 = 1 - q0 and b1^2 = 1 - q1.
        const N sign = select(copy_sign(1.0, b0) == copy_sign(1.0, b1), -1.0, 1.0);
        const Mask<N> cancels = au.cosine * sign < 0.0;  // otherwise cos(au) + sign is computed as it is
        const N cosine_less_sign =
            select(cancels, sign * (au.sine * au.sine) / (1.0 - sign * au.cosine), au.cosine + sign);
        const N b_difference = copy_sign(1.0, b1) * (q1 - q0) / (abs(b0) + abs(b1));
        const N fu = (cosine_less_sign * b0 + b_difference) / au.sine;
        // Compute the coordinate x of the sample, then y from v. By rounding fu^2 - q0 may be 0 or negative. The result
        // is then beyond x0 or x1, and clamped to it.
        const N xu = min(max(copy_sign(-z0_, fu) / sqrt(max(fu * fu - q0, 1e-300)), x0_), x1_);
        const N distance2 = xu * xu + z2;
        const N h0 = y0_ / sqrt(distance2 + y0_ * y0_), h1 = y1_ / sqrt(distance2 + y1_ * y1_);
        const N hv = h0 + v * (h1 - h0), rest = 1.0 - hv * hv;
        const N inward = min(max(hv * sqrt(distance2 / rest), y0_), y1_);
        const N yv = select(rest > 0.0, inward, select(hv < 0.0, y0_, y1_));
        return {(xu - x0_) / (x1_ - x0_), (yv - y0_) / (y1_ - y0_)};
    }

private:
    // Returns sine and cosine of the sum of two angles.
    static HWY_INLINE SineCosine<N> sum(const SineCosine<N>& a, const SineCosine<N>& b) {
        return {a.sine * b.cosine + a.cosine * b.sine, a.cosine * b.cosine - a.sine * b.sine};
    }

    N x0_, x1_, y0_, y1_, z0_;  // the rectangle relative to `from`: [x0, x1] by [y0, y1] in the plane z = z0 <= 0
    N over_y0_, over_y1_;       // reciprocal distances of the edges at y0 and y1 from `from`
    N solid_angle_;
    SineCosine<N> g23_;  // sum of the inner angles at the two corners with x = x0
};

// A spherical triangle. The sampling follows Arvo, Stratified Sampling of Spherical Triangles, SIGGRAPH 1995. The solid
// angle is computed by the formula of Van Oosterom and Strackee, IEEE Transactions on Biomedical Engineering 30(2),
// 1983.
template <class N>
class SphericalTriangle {
public:
    // The arguments are the unit vectors towards the corners. \pre no two of them are opposite
    HWY_INLINE SphericalTriangle(const Vector<N>& a, const Vector<N>& b, const Vector<N>& c)
        : a_(a), b_(b), c_(c), cos_c_(dot(a, b)), volume_(abs(dot(a, cross(b - a, c - a)))) {
        solid_angle_ = 2.0 * angle_of<N>({volume_, 1.0 + cos_c_ + dot(b, c) + dot(c, a)});
    }

    // Returns the solid angle in steradians. It is 0 if the corners are on a great circle.
    N solid_angle() const { return solid_angle_; }

    // Returns a uniform unit vector towards the triangle: its pdf is 1 / solid_angle() per solid angle.
    // \pre solid_angle() > 0
    //
    // A corner p moves from a towards c until the triangle a, b, p has the solid angle s = u solid_angle(). The result
    // is on the arc from b to p; v determines how far along.
    //
    // Let p = cos(t) a + sin(t) e, where e is the unit vector perpendicular to a in the plane of a and c. The formula
    // for the solid angle becomes
    //     tan(s / 2) = sin(t) |e . (a x b)| / ((1 + a.b) (1 + cos(t)) + sin(t) b.e).
    // With tan(t / 2) = sin(t) / (1 + cos(t)) this is solved by
    //     tan(t / 2) = sin(s / 2) (1 + a.b) / (cos(s / 2) |e . (a x b)| - sin(s / 2) b.e) = rise / run.
    HWY_INLINE Vector<N> sample(N u, N v) const {
        // Find the corner p. Its sine and cosine of t follow from tan(t / 2) = rise / run.
        const SineCosine<N> half = sine_cosine_of_turns<N>(u * solid_angle_ * (1 / (4 * kPi)));
        const Vector<N> along = c_ - dot(a_, c_) * a_;  // e, times its length
        const N scale = 1.0 / sqrt(length_squared(along));
        const N rise = half.sine * (1.0 + cos_c_);
        const N run = half.cosine * (volume_ * scale) - half.sine * (dot(b_, along) * scale);
        const N over = 1.0 / (rise * rise + run * run);
        const Vector<N> p = ((run * run - rise * rise) * over) * a_ + (2.0 * rise * run * over * scale) * along;
        // Find the direction on the arc from b to p. If x is the angle to b, the 1 - cos(x) of the direction is v times
        // the 1 - cos(x) of p. For p it is computed as |b - p|^2 / 2, which does not cancel if p is close to b.
        const N fall = v * (length_squared(b_ - p) / 2.0);
        const Vector<N> aside = p - dot(b_, p) * b_;
        const N length_aside = sqrt(length_squared(aside));
        const Vector<N> turned = (1.0 - fall) * b_ + (sqrt(max(0.0, fall * (2.0 - fall))) / length_aside) * aside;
        return select(length_aside > 0.0, turned, b_);
    }

private:
    Vector<N> a_, b_, c_;
    N cos_c_;   // cosine of the side from a to b
    N volume_;  // |a . (b x c)|
    N solid_angle_;
};

}  // namespace limn::sampling::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
