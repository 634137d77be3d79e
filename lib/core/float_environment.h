// The floating-point environment that limn's arithmetic is proved in: rounding to nearest, subnormals kept, no traps. A
// caller may have set its thread otherwise (to flush subnormals, as other ray tracers ask for; to round upward; to trap
// a division by zero, which the slab test does on purpose), so every entry into limn holds one of these while it works.
#pragma once

namespace limn {

#if defined(__x86_64__) && defined(__GNUC__)

// Where the caller's environment is the default one already, this only reads a register.
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
    static constexpr unsigned kDefault = 0x1f80, kFlags = 0x3f;  // of MXCSR; flags are what has been raised so far
    bool is_changed() const { return (callers_ & ~kFlags) != kDefault; }
    unsigned callers_;
};

#else

// Elsewhere the caller has to leave the environment as a program finds it.
class FloatEnvironment {
public:
    FloatEnvironment() {}
};

#endif

}  // namespace limn
