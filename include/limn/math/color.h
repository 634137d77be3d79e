/// \file
/// Colours: linear RGB with BT.709 primaries.
#pragma once

#include <cmath>

namespace limn {

/// A linear RGB colour: a radiance, or a reflectance in [0, 1]. Arithmetic is by component. Components may be negative
/// or infinite; functions that accept fewer values say so.
struct Color {
    /// Red, green and blue; black by default.
    ///@{
    double r = 0, g = 0, b = 0;

    constexpr Color() = default;
    constexpr Color(double r_, double g_, double b_) : r(r_), g(g_), b(b_) {}
    constexpr bool operator==(const Color&) const = default;
    ///@}

    /// Add or multiply by component.
    ///@{
    constexpr Color& operator+=(const Color& c) {
        r += c.r;
        g += c.g;
        b += c.b;
        return *this;
    }
    constexpr Color& operator*=(const Color& c) {
        r *= c.r;
        g *= c.g;
        b *= c.b;
        return *this;
    }
    ///@}
};

/// Return the result of the operation on each component.
///@{
constexpr Color operator+(const Color& a, const Color& b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
constexpr Color operator-(const Color& a, const Color& b) { return {a.r - b.r, a.g - b.g, a.b - b.b}; }
constexpr Color operator*(const Color& a, const Color& b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
constexpr Color operator*(double s, const Color& a) { return {s * a.r, s * a.g, s * a.b}; }
constexpr Color operator*(const Color& a, double s) { return s * a; }
constexpr Color operator/(const Color& a, double s) { return {a.r / s, a.g / s, a.b / s}; }
///@}

/// Returns the relative luminance (ITU-R BT.709-6, section 3.2).
constexpr double luminance(const Color& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }
/// Returns the largest component.
constexpr double max_component(const Color& c) { return c.r > c.g ? (c.r > c.b ? c.r : c.b) : (c.g > c.b ? c.g : c.b); }
/// Returns true if all components are exactly zero.
constexpr bool is_black(const Color& c) { return c.r == 0 && c.g == 0 && c.b == 0; }
/// Returns true if no component is infinite or NaN.
inline bool is_finite(const Color& c) { return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b); }

/// The sRGB transfer function and its inverse (IEC 61966-2-1:1999, section 5.2). They are odd functions, f(-x) = -f(x),
/// and don't clamp values above 1.
///@{
double srgb_encode(double linear);
double srgb_decode(double encoded);
///@}

}  // namespace limn
