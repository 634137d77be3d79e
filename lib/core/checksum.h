// Checksums and digests by XXH3, the same on every processor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <type_traits>

#include "limn/core/hash128.h"

namespace limn {

// Of bytes that come one after the other; how they are cut into pieces does not matter.
class Checksum {
public:
    Checksum();
    ~Checksum();
    Checksum(const Checksum&) = delete;
    Checksum& operator=(const Checksum&) = delete;

    void add(std::span<const std::byte> bytes);
    // A number, by its bits. Structures have padding, whose bits are anything.
    template <class T>
    requires std::is_arithmetic_v<T> || std::is_enum_v<T>
    void add(T value) { add(std::as_bytes(std::span(&value, 1))); }
    // With its length, so that "ab" and "c" differ from "a" and "bc".
    void add(std::string_view text);

    Hash128 digest() const;
    std::uint64_t value() const { return digest()[0]; }  // half of it

private:
    struct State;
    std::unique_ptr<State> state_;
};

// Checksum::value of so many bytes.
std::uint64_t checksum(std::span<const std::byte> bytes);

}  // namespace limn
