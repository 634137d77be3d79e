#include "answer_writer.h"

#include <bit>
#include <charconv>

#include "limn/math/math.h"
#include "text_file.h"

namespace limn::app {

void AnswerWriter::hit(double t, std::uint32_t face, double u, double v) {
    if (binary_) {
        for (const double value : {t, static_cast<double>(face), u, v}) number(value);
        return;
    }
    number(t);
    block_ += ' ' + std::to_string(face) + ' ';
    number(u);
    block_ += ' ';
    number(v);
    block_ += '\n';
}

void AnswerWriter::miss() {
    if (binary_)
        for (const double value : {kInfinity, -1.0, 0.0, 0.0}) number(value);
    else
        block_ += "miss\n";
}

void AnswerWriter::occluded(bool is_hit) {
    if (binary_)
        number(is_hit ? 1 : 0);
    else
        block_ += is_hit ? "1\n" : "0\n";
}

void AnswerWriter::flush() {
    write_text("-", block_);
    block_.clear();
}

void AnswerWriter::number(double value) {
    if (binary_) {
        const auto bits = std::bit_cast<std::uint64_t>(value);
        for (int shift = 0; shift < 64; shift += 8) block_ += static_cast<char>(bits >> shift & 255);
        return;
    }
    char text[32];  // -1.2345678901234567e-308 has 24 characters
    const auto [end, _] = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 17);
    block_.append(text, end);
}

}  // namespace limn::app
