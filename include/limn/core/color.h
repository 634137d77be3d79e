/// \file
/// Linear RGB with BT.709 primaries: radiance, or a reflectance in [0, 1].
#pragma once

#include <cmath>

namespace limn {

/// Three components; arithmetic is by component. Negative and infinite ones are let through: what a function accepts,
/// it says.
struct Color {
    /// The components, black by default.
    ///@{
    double r = 0, g = 0, b = 0;

    constexpr Color() = default;
    constexpr Color(double r_, double g_, double b_) : r(r_), g(g_), b(b_) {}
    constexpr bool operator==(const Color&) const = default;
    ///@}

    /// By component.
    ///@{
    constexpr Color& operator+=(const Color& c) {
        r += c.r, g += c.g, b += c.b;
        return *this;
    }
    constexpr Color& operator*=(const Color& c) {
        r *= c.r, g *= c.g, b *= c.b;
        return *this;
    }
    ///@}
};

/// By component.
///@{
constexpr Color operator+(const Color& a, const Color& b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
constexpr Color operator-(const Color& a, const Color& b) { return {a.r - b.r, a.g - b.g, a.b - b.b}; }
constexpr Color operator*(const Color& a, const Color& b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
constexpr Color operator*(double s, const Color& a) { return {s * a.r, s * a.g, s * a.b}; }
constexpr Color operator*(const Color& a, double s) { return s * a; }
constexpr Color operator/(const Color& a, double s) { return {a.r / s, a.g / s, a.b / s}; }
///@}

/// Relative luminance (ITU-R BT.709-6, section 3.2).
constexpr double luminance(const Color& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }
/// The largest of the three.
constexpr double max_component(const Color& c) { return c.r > c.g ? (c.r > c.b ? c.r : c.b) : (c.g > c.b ? c.g : c.b); }
/// Exactly zero in all three.
constexpr bool is_black(const Color& c) { return c.r == 0 && c.g == 0 && c.b == 0; }
/// Neither infinite nor NaN in any component.
inline bool is_finite(const Color& c) { return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b); }

/// The sRGB transfer function and its inverse (IEC 61966-2-1:1999, section 5.2), extended oddly below zero and not
/// clamped above 1.
///@{
double srgb_encode(double linear);
double srgb_decode(double encoded);
///@}

}  // namespace limn
