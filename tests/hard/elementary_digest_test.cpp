// One number for each elementary function, the same in every build and whatever the C library: math/elementary.h.
#include "catch.h"
#include "math/elementary.h"
#include "math/system/checksum.h"
#include "support/text.h"

namespace limn::elementary_digest_test {

using namespace test;

TEST_CASE("Digest: the elementary functions have the same bits in every build", "[hard][digest]") {
    const struct {
        const char* name;
        double (*function)(double);
        double from, to;
        std::string digest;
    } rows[] = {
        {"sine", sine, -9, 9, "2e1f6af5e120f017"},
        {"cosine", cosine, -9, 9, "578212249530fd91"},
        {"tangent", tangent, -9, 9, "565d7e587662c5ee"},
        {"arc cosine", arc_cosine, -1, 1, "8bc0b75d39201aef"},
        {"arc tangent", arc_tangent, -9, 9, "22d683f5957d6e2e"},
        {"exponential", exponential, -40, 40, "5641a7bfa7626249"},
        {"logarithm", logarithm, 0, 9, "9304fbbfd61192c4"},
        {"logarithm of 1 + x", logarithm_of_1_plus, -1, 9, "739f52a4c423703d"},
        {"power", [](double x) { return power(x, 2.4); }, 0, 9, "34864cafbe66b4a6"},
    };
    constexpr int kSteps = 10000;
    for (const auto& row : rows) {
        Checksum sum;
        for (int i = 0; i < kSteps; ++i) sum.add(row.function(row.from + (row.to - row.from) * (i / double{kSteps})));
        INFO(row.name);
        CHECK(hexadecimal(sum.value()) == row.digest);
    }
}

}  // namespace limn::elementary_digest_test
