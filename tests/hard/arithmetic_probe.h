// Arithmetic that compilers change if they are allowed to; compiled as limn's sources are, for processors with fused
// multiply-adds.
#pragma once

#include <cstddef>

namespace limn::test {

double product_plus(double a, double b, double c);
double total(const double* values, std::size_t count);  // from the first on
void round_to_float(const double* values, double* rounded, std::size_t count);
void round_four_to_float(const double* values, double* rounded);

}  // namespace limn::test
