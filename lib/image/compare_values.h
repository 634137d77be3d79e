// What all comparisons of two images begin with.
#pragma once

#include <string>

#include "limn/core/error.h"
#include "limn/image/image.h"

namespace limn {

// What relMSE adds to the squared reference, so that dark pixels do not dominate.
inline constexpr double kDarkness = 0.01;

// The reference's value whose two halves these are.
inline double mean_of_halves(float a, float b) { return (static_cast<double>(a) + b) / 2; }

inline double relative_squared_error(double x, double r) { return (x - r) * (x - r) / (r * r + kDarkness); }

// \throws ArgumentError
inline void require_same_size(const Image& test, const Image& reference, const std::string& function) {
    const auto size = [](const Image& i) { return std::to_string(i.width()) + " x " + std::to_string(i.height()); };
    if (test.width() != reference.width() || test.height() != reference.height())
        throw ArgumentError(function + ": the images differ in size: " + size(test) + " and " + size(reference));
    if (test.empty()) throw ArgumentError(function + ": the images are empty");
}

}  // namespace limn
