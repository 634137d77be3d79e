/// \file
/// The results of `limn trace`.
#pragma once

#include <cstdint>
#include <string>

namespace limn::app {

/// Results on standard output. As text one a line, with the 17 digits that bring every float64 back; as binary
/// little-endian float64.
class AnswerWriter {
public:
    explicit AnswerWriter(bool binary) : binary_(binary) {}

    /// `t face u v`, or four numbers.
    void hit(double t, std::uint32_t face, double u, double v);
    /// `miss`, or infinity, -1, 0, 0.
    void miss();
    /// 1 or 0.
    void occluded(bool is_hit);

    /// Writes the results since the last call. \throws FileError
    void flush();

private:
    void number(double value);

    bool binary_;
    std::string block_;
};

}  // namespace limn::app
