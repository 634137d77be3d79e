#include "hard/arithmetic_probe.h"

namespace limn::test {

double product_plus(double a, double b, double c) { return a * b + c; }

double total(const double* values, std::size_t count) {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += values[i];
    return sum;
}

void round_to_float(const double* values, double* rounded, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) rounded[i] = static_cast<double>(static_cast<float>(values[i]));
}

void round_four_to_float(const double* values, double* rounded) {
    const double a = values[0] + 1, b = values[1] + 1, c = values[2] + 1, d = values[3] + 1;
    rounded[0] = static_cast<double>(static_cast<float>(a)), rounded[1] = static_cast<double>(static_cast<float>(b));
    rounded[2] = static_cast<double>(static_cast<float>(c)), rounded[3] = static_cast<double>(static_cast<float>(d));
}

}  // namespace limn::test
