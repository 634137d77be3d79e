// Rays and answers in the forms of `limn trace`, written without its code.
#pragma once

#include <fmt/format.h>

#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "limn/math/ray.h"

namespace limn::test {

inline std::vector<double> numbers_of(const Ray& r) {
    return {r.origin.x, r.origin.y, r.origin.z, r.direction.x, r.direction.y, r.direction.z, r.t_min, r.t_max};
}

inline std::string to_text(const Ray& ray) {
    std::string line;
    for (const double number : numbers_of(ray)) line += fmt::format("{:.17g} ", number);
    line.back() = '\n';
    return line;
}

/// As the machines that limn is tested on store them: little-endian.
inline std::string to_binary(const std::vector<double>& numbers) {
    std::string bytes(sizeof(double) * numbers.size(), '\0');
    std::memcpy(bytes.data(), numbers.data(), bytes.size());
    return bytes;
}

inline std::vector<double> from_binary(const std::string& bytes) {
    std::vector<double> numbers(bytes.size() / sizeof(double));
    std::memcpy(numbers.data(), bytes.data(), sizeof(double) * numbers.size());
    return numbers;
}

inline std::vector<std::string> lines(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/// The triangle (0, 0, 0), (4, 0, 0), (0, 4, 0).
inline constexpr const char* kTriangleObj = "v 0 0 0\nv 4 0 0\nv 0 4 0\nf 1 2 3\n";
/// Hits it at t = 1.5 with weights 1/4 and 1/2; all that the computation meets is exact.
inline constexpr const char* kTriangleRay = "1 2 3 0 0 -2";
inline constexpr const char* kTriangleAnswer = "1.5 0 0.25 0.5";

}  // namespace limn::test
