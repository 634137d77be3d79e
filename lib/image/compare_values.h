// Shared parts of the comparisons of two images.
#pragma once

#include <string>

#include "limn/image/image.h"
#include "limn/math/error.h"

namespace limn {

// The constant that relMSE adds to the squared reference. It keeps pixels much darker than 0.1 from dominating relMSE.
inline constexpr double kDarkness = 0.01;

// Returns a value of a reference that is given as two halves a and b: the mean of both.
inline double mean_of_halves(float a, float b) { return (static_cast<double>(a) + b) / 2; }

// Returns the term of relMSE for a value x of the test image and a value r of the reference.
inline double relative_squared_error(double x, double r) { return (x - r) * (x - r) / (r * r + kDarkness); }

// Throws ArgumentError if the sizes differ or the images are empty.
inline void require_same_size(const Image& test, const Image& reference, const std::string& function) {
    const auto size = [](const Image& i) { return std::to_string(i.width()) + " x " + std::to_string(i.height()); };
    if (test.width() != reference.width() || test.height() != reference.height())
        throw ArgumentError(function + ": the images differ in size: " + size(test) + " and " + size(reference));
    if (test.empty()) throw ArgumentError(function + ": the images are empty");
}

}  // namespace limn
