/// \file
/// Writing the results of `limn trace`.
#pragma once

#include <cstdint>
#include <string>

namespace limn::app {

/// Writes results to standard output. As text, each result is a line; numbers have 17 digits, so that reading them
/// gives the same float64. As binary, a result is one or four little-endian float64.
class AnswerWriter {
public:
    explicit AnswerWriter(bool binary) : binary_(binary) {}

    /// Adds the result `t face u v`, four numbers in binary.
    void hit(double t, std::uint32_t face, double u, double v);
    /// Adds the result `miss`; in binary infinity, -1, 0, 0.
    void miss();
    /// Adds the result 1 or 0.
    void occluded(bool is_hit);

    /// Writes the results that were added since the last call. \throws FileError
    void flush();

private:
    void number(double value);

    bool binary_;
    std::string block_;  // results that are not written yet
};

}  // namespace limn::app
