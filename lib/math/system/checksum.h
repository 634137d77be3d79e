// Checksums and digests computed with XXH3. Their values are the same on every processor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <type_traits>

#include "limn/math/hash128.h"

namespace limn {

// A checksum of bytes that are added one piece after the other. Only the bytes and their order count; it doesn't matter
// how they are cut into pieces.
class Checksum {
public:
    Checksum();
    ~Checksum();
    Checksum(const Checksum&) = delete;
    Checksum& operator=(const Checksum&) = delete;

    void add(std::span<const std::byte> bytes);
    // Adds the bytes of a number. Structures are excluded because the bytes of their padding are indeterminate.
    template <class T>
    requires std::is_arithmetic_v<T> || std::is_enum_v<T>
    void add(T value) { add(std::as_bytes(std::span(&value, 1))); }
    // Adds the length of the text as 64 bits, then its bytes. Therefore "ab" and "c" give another digest than "a" and
    // "bc".
    void add(std::string_view text);

    // Returns the 128-bit hash of all bytes added so far.
    Hash128 digest() const;
    // Returns the lower 64 bits of digest().
    std::uint64_t value() const { return digest()[0]; }

private:
    struct State;
    std::unique_ptr<State> state_;
};

// Returns Checksum::value() of these bytes alone.
std::uint64_t checksum(std::span<const std::byte> bytes);

}  // namespace limn
