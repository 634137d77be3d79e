// The floating-point environment that the proofs of limn's arithmetic assume: rounding to nearest, subnormals kept, no
// traps.
//
// A thread that calls limn may have another environment. Other ray tracers ask their users to flush subnormals. A
// program may round upward, or trap divisions by zero, which the slab test does on purpose. Therefore limn sets the
// environment in a few places that all work passes: ask() for queries (query/ask.h), the loops of math/parallel.h,
// BuiltInShape, and math/surface.cpp. Constructors that decide something exactly set it too.
#pragma once

namespace limn {

#if defined(__x86_64__) && defined(__GNUC__)

// Gives the calling thread the default environment for the lifetime of this object, then restores the caller's. If the
// caller's is the default already, this only reads a register.
class FloatEnvironment {
public:
    FloatEnvironment() : callers_(__builtin_ia32_stmxcsr()) {
        if (is_changed()) __builtin_ia32_ldmxcsr(kDefault);
    }
    ~FloatEnvironment() {
        if (is_changed()) __builtin_ia32_ldmxcsr(callers_);
    }
    FloatEnvironment(const FloatEnvironment&) = delete;
    FloatEnvironment& operator=(const FloatEnvironment&) = delete;

private:
    // The default value of the register MXCSR, and the bits that record exceptions raised so far.
    static constexpr unsigned kDefault = 0x1f80, kFlags = 0x3f;
    bool is_changed() const { return (callers_ & ~kFlags) != kDefault; }
    unsigned callers_;
};

#else

// On other platforms this does nothing. There the caller must not change the environment that a program starts with.
class FloatEnvironment {
public:
    FloatEnvironment() {}
};

#endif

}  // namespace limn
