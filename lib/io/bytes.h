// Reads numbers and text from the bytes of a file that may be damaged.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace limn {

// A reason why a file cannot be read. It is thrown without the file's name. Callers catch it and throw a FileError with
// the name (image_checks.cpp, load_model.cpp).
struct Fault {
    std::string text;
};

// Throws a Fault unless `holds` is true.
inline void demand(bool holds, std::string_view fault) {
    if (!holds) throw Fault{std::string(fault)};
}

inline constexpr const char* kBreaksOff = "it breaks off before its end";

// Return the unsigned integer in the `count` bytes from `place` on. \pre count <= 8 and place + count <= bytes.size()
inline std::uint64_t little_endian(std::span<const std::byte> bytes, std::size_t place, std::size_t count) {
    std::uint64_t value = 0;
    for (std::size_t i = count; i-- > 0;) value = value << 8 | std::to_integer<std::uint64_t>(bytes[place + i]);
    return value;
}
inline std::uint64_t big_endian(std::span<const std::byte> bytes, std::size_t place, std::size_t count) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count; ++i) value = value << 8 | std::to_integer<std::uint64_t>(bytes[place + i]);
    return value;
}

// Returns a view of the bytes as characters.
inline std::string_view text_of(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Reads bytes from front to back. Throws a Fault with the text `fault` if fewer bytes are left than it is to read.
class Cursor {
public:
    explicit Cursor(std::span<const std::byte> bytes, const char* fault = kBreaksOff) : rest_(bytes), fault_(fault) {}
    std::span<const std::byte> rest() const { return rest_; }  // returns the bytes that are not read yet

    // Reads `size` bytes.
    std::span<const std::byte> take(std::size_t size) {
        demand(size <= rest_.size(), fault_);
        const std::span<const std::byte> taken = rest_.first(size);
        rest_ = rest_.subspan(size);
        return taken;
    }
    // Read an unsigned integer of at most 8 bytes, little-endian or big-endian.
    std::uint64_t little(std::size_t bytes) { return little_endian(take(bytes), 0, bytes); }
    std::uint64_t big(std::size_t bytes) { return big_endian(take(bytes), 0, bytes); }

private:
    std::span<const std::byte> rest_;
    const char* fault_;
};

}  // namespace limn
