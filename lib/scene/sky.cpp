#include "limn/scene/sky.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "limn/math/math.h"
#include "math/elementary.h"
#include "math/equirectangular-inl.h"
#include "math/require.h"

HWY_BEFORE_NAMESPACE();
namespace limn {

namespace {

// The factor by which limn converts photometric units to radiometric ones.
constexpr double kLumensPerWatt = 683;
constexpr double kSunIlluminance = 128e3;  // outside the atmosphere, in lx

// Perez's function of the angles to the zenith and to the Sun. Its coefficients are linear in the turbidity.
struct Perez {
    std::array<double, 5> slope, offset;

    double operator()(double turbidity, double cos_zenith, double from_sun) const {
        const auto c = [&](std::size_t i) { return slope[i] * turbidity + offset[i]; };
        const double cos_sun = cosine(from_sun);
        return (1 + c(0) * exponential(c(1) / cos_zenith)) *
               (1 + c(2) * exponential(c(3) * from_sun) + c(4) * cos_sun * cos_sun);
    }
};
constexpr Perez kLuminance{{0.1787, -0.3554, -0.0227, 0.1206, -0.0670}, {-1.4630, 0.4275, 5.3251, -2.5771, 0.3703}};
constexpr Perez kX{{-0.0193, -0.0665, -0.0004, -0.0641, -0.0033}, {-0.2592, 0.0008, 0.2125, -0.8989, 0.0452}};
constexpr Perez kY{{-0.0167, -0.0950, -0.0079, -0.0441, -0.0109}, {-0.2608, 0.0092, 0.2102, -1.6537, 0.0529}};

// The chromaticity of the zenith as a polynomial. Rows are for turbidity^2, turbidity and 1. Columns are for the powers
// 3, 2, 1 and 0 of the Sun's angle to the zenith.
using Matrix = std::array<std::array<double, 4>, 3>;
constexpr Matrix kZenithX{
    {{0.00166, -0.00375, 0.00209, 0}, {-0.02903, 0.06377, -0.03202, 0.00394}, {0.11693, -0.21196, 0.06052, 0.25886}}};
constexpr Matrix kZenithY{
    {{0.00275, -0.00610, 0.00317, 0}, {-0.04214, 0.08970, -0.04153, 0.00516}, {0.15346, -0.26756, 0.06670, 0.26688}}};

// Returns the value of the polynomial.
double at_zenith(const Matrix& m, double turbidity, double sun) {
    double sum = 0;
    for (const auto& row : m) sum = sum * turbidity + ((row[0] * sun + row[1]) * sun + row[2]) * sun + row[3];
    return sum;
}

// Returns the linear BT.709 colour of a chromaticity and luminance (ITU-R BT.709-6, section 1). Components of colours
// outside its gamut are clamped to 0.
Color from_chromaticity(double x, double y, double luminance) {
    const double X = x / y * luminance, Z = (1 - x - y) / y * luminance;
    const Color c{3.2404542 * X - 1.5371385 * luminance - 0.4985314 * Z,
                  -0.9692660 * X + 1.8760108 * luminance + 0.0415560 * Z,
                  0.0556434 * X - 0.2040259 * luminance + 1.0572252 * Z};
    return {std::max(c.r, 0.0), std::max(c.g, 0.0), std::max(c.b, 0.0)};
}

// The light of the sky and of the Sun at a turbidity and a direction of the Sun.
class Skylight {
public:
    Skylight(double turbidity, const Vec3& to_sun)
        : turbidity_(turbidity), to_sun_(to_sun), sun_(arc_cosine(std::min(to_sun.y, 1.0))) {
        const double chi = (4.0 / 9 - turbidity / 120) * (kPi - 2 * sun_);
        const double luminance = (4.0453 * turbidity - 4.9710) * tangent(chi) - 0.2155 * turbidity + 2.4192;
        luminance_ = 1000 * luminance / kLuminance(turbidity, 1, sun_);
        x_ = at_zenith(kZenithX, turbidity, sun_) / kX(turbidity, 1, sun_);
        y_ = at_zenith(kZenithY, turbidity, sun_) / kY(turbidity, 1, sun_);
    }

    // Returns the luminance of the sky as a colour, in cd / m^2. \pre direction.y > 0
    Color operator()(const Vec3& direction) const {
        const double from_sun = arc_cosine(std::clamp(dot(direction, to_sun_), -1.0, 1.0));
        const auto of = [&](const Perez& perez) { return perez(turbidity_, direction.y, from_sun); };
        return from_chromaticity(x_ * of(kX), y_ * of(kY), std::max(0.0, luminance_ * of(kLuminance)));
    }

    // Returns the Sun's illuminance of a plane perpendicular to its direction, as a colour in lx. The air mass is that
    // of Kasten.
    Color sun() const {
        const double mass = 1 / (cosine(sun_) + 0.15 * power(93.885 - sun_ * 180 / kPi, -1.253));
        const double haze = 0.04608 * turbidity_ - 0.04586;
        const auto passes = [&](double micrometres) {
            return exponential(-mass * (0.008735 * power(micrometres, -4.08) + haze * power(micrometres, -1.3)));
        };
        return kSunIlluminance * Color{passes(0.68), passes(0.55), passes(0.44)};
    }

private:
    double turbidity_;
    Vec3 to_sun_;
    double sun_;                // angle of the Sun to the zenith
    double luminance_, x_, y_;  // luminance and chromaticity of the zenith, divided by Perez's functions there
};

// Throws ArgumentError if a setting is out of range.
void check(const SkySettings& s, const Vec3& to_sun) {
    require(is_finite(to_sun) && to_sun.y > 0, "SkySettings: to_sun must point above the horizon");
    require(s.turbidity >= 2 && s.turbidity <= 10, "SkySettings: turbidity must lie within [2, 10]");
    require(is_reflectance(s.ground), "SkySettings: ground must lie within [0, 1]");
    require(std::isfinite(s.scale) && s.scale >= 0, "SkySettings: scale must be finite and not negative");
    require(s.height >= 2 && s.height <= 8192, "SkySettings: height must lie within 2 and 8192");
}

}  // namespace

Sky make_sky(const SkySettings& settings) {
    // Prepare the model.
    const Vec3 to_sun = normalize(settings.to_sun);
    check(settings, to_sun);
    const Skylight skylight(settings.turbidity, to_sun);
    const double unit = settings.scale / kLumensPerWatt;
    const int height = settings.height, width = 2 * height, horizon = height / 2;
    // Fill the upper half of the map, and integrate the irradiance of the ground.
    Image image(width, height);
    SunLight sun{.direction = -to_sun, .irradiance = unit * skylight.sun()};
    Color irradiance = to_sun.y * sun.irradiance;
    for (int y = 0; y < horizon; ++y) {
        const auto [sine, cosine] = sine_cosine(kPi * (y + 0.5) / height);
        const double share = kPi / height * (2 * kPi / width) * sine * cosine;
        for (int x = 0; x < width; ++x) {
            const auto d = sampling::HWY_NAMESPACE::map_direction<double>((x + 0.5) / width, cosine, sine);
            const Color radiance = unit * skylight({d.x, d.y, d.z});
            image.set(x, y, radiance);
            irradiance += share * radiance;
        }
    }
    // Fill the lower half with the ground.
    const Color ground = settings.ground * irradiance / kPi;
    for (int y = horizon; y < height; ++y)
        for (int x = 0; x < width; ++x) image.set(x, y, ground);
    return {std::make_shared<EnvironmentMap>(std::move(image)), sun};
}

}  // namespace limn
HWY_AFTER_NAMESPACE();
