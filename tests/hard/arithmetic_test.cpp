// The flags by which every compiler rounds where the source says so: limn_exact_arithmetic in cmake/LimnDefaults.cmake.
#include <fstream>
#include <sstream>
#include <vector>

#include "catch.h"
#include "hard/arithmetic_probe.h"

namespace limn::arithmetic_test {

using namespace test;

namespace {

bool has_fused_multiply_add() {
#if defined(__x86_64__)
    return __builtin_cpu_supports("fma") && __builtin_cpu_supports("avx2");
#else
    return true;
#endif
}

// The commands that compile the library's sources.
std::vector<std::string> library_commands() {
    std::ifstream in(LIMN_COMPILE_COMMANDS);
    std::vector<std::string> found;
    for (std::string line; std::getline(in, line);) {
        const bool is_command = line.find("\"command\"") != std::string::npos;
        for (const char* const target : {"CMakeFiles/limn_core.dir/", "CMakeFiles/limn_io_objects.dir/"})
            if (is_command && line.find(target) != std::string::npos) found.push_back(line);
    }
    return found;
}

}  // namespace

TEST_CASE("Arithmetic: every source of the library is compiled with the flags that keep its roundings",
          "[hard][arithmetic]") {
    const std::vector<std::string> commands = library_commands();
    CHECK(commands.size() > 50);
    for (const std::string& command : commands) {
        INFO(command);
        const std::size_t exact = command.find(" -fno-fast-math "), contract = command.rfind(" -ffp-contract=off ");
        REQUIRE(exact != std::string::npos);
        REQUIRE(contract != std::string::npos);
        CHECK(exact < contract);
        for (const char* const flag : {"-ffast-math", "-Ofast", "-funsafe-math-optimizations", "-fassociative-math"}) {
            const std::size_t at = command.rfind(flag);
            CHECK((at == std::string::npos || at < exact));  // what a project sets for all of its own
        }
#if defined(__GNUC__) && !defined(__clang__)
        CHECK(command.find(" -fno-tree-slp-vectorize ") != std::string::npos);
#endif
    }
}

TEST_CASE("Arithmetic: products are rounded before they are added, sums are taken in order, floats are rounded",
          "[hard][arithmetic]") {
    if (!has_fused_multiply_add()) return;
    const double x = 1 + 0x1p-30;
    CHECK(product_plus(x, x, -(1 + 0x1p-29)) == 0);  // fused: 2^-60
    std::vector<double> values(64, 1.0);
    for (std::size_t i = 0; i < values.size(); i += 2) values[i] = i % 4 == 0 ? 0x1p54 : -0x1p54;
    double sum = 0;
    for (const double value : values) {
        volatile double next = sum + value;
        sum = next;
    }
    CHECK(total(values.data(), values.size()) == sum);
    std::vector<double> tenths, rounded(64);
    for (int i = 0; i < 64; ++i) tenths.push_back(0.1 * i);
    round_to_float(tenths.data(), rounded.data(), tenths.size());
    for (std::size_t i = 1; i < tenths.size(); ++i) {
        volatile float single = static_cast<float>(tenths[i]);
        CHECK(rounded[i] == static_cast<double>(single));
    }
    round_four_to_float(tenths.data(), rounded.data());
    for (std::size_t i = 0; i < 4; ++i) {
        volatile float single = static_cast<float>(tenths[i] + 1);
        CHECK(rounded[i] == static_cast<double>(single));
    }
}

}  // namespace limn::arithmetic_test
