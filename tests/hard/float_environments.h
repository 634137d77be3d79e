// Floating-point environments that a caller of limn may have.
#pragma once

#include <immintrin.h>

namespace limn::test {

inline constexpr unsigned kDefault = 0x1f80, kFlags = 0x3f;  // of MXCSR: everything masked, nothing flushed, to nearest
inline constexpr unsigned kFlush = 0x8040, kDown = 0x2000, kUp = 0x4000, kToZero = 0x6000;

struct Environment {
    const char* name;
    unsigned csr;
};

inline constexpr Environment kEnvironments[] = {
    {"subnormals flushed", kDefault | kFlush},
    {"rounding up", kDefault | kUp},
    {"rounding down", kDefault | kDown},
    {"rounding to zero", kDefault | kToZero},
    {"flushed, rounding up", kDefault | kFlush | kUp},
    {"flushed, rounding down", kDefault | kFlush | kDown},
};

// For as long as it lives. Only limn is called meanwhile; what a test itself computes would be rounded otherwise too.
class InEnvironment {
public:
    explicit InEnvironment(unsigned csr) : csr_(csr), before_(_mm_getcsr()) { _mm_setcsr(csr); }
    ~InEnvironment() { _mm_setcsr(before_); }
    bool is_as_it_was() const { return (_mm_getcsr() & ~kFlags) == (csr_ & ~kFlags); }

private:
    unsigned csr_, before_;
};

}  // namespace limn::test
