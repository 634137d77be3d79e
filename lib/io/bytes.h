// Bytes of a file, none of which is believed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace limn {

// What keeps a file from being read. Thrown without the file's name, which callers add (io/image_checks.h, load_model).
struct Fault {
    std::string text;
};

inline void demand(bool holds, std::string_view fault) {
    if (!holds) throw Fault{std::string(fault)};
}

inline constexpr const char* kBreaksOff = "it breaks off before its end";

// Of `count` bytes, at most eight, from `place` on, all of which must be there.
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

inline std::string_view text_of(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Steps through bytes; where they end too early there is a fault.
class Cursor {
public:
    explicit Cursor(std::span<const std::byte> bytes, const char* fault = kBreaksOff) : rest_(bytes), fault_(fault) {}
    std::span<const std::byte> rest() const { return rest_; }

    std::span<const std::byte> take(std::size_t size) {
        demand(size <= rest_.size(), fault_);
        const std::span<const std::byte> taken = rest_.first(size);
        rest_ = rest_.subspan(size);
        return taken;
    }
    std::uint64_t little(std::size_t bytes) { return little_endian(take(bytes), 0, bytes); }
    std::uint64_t big(std::size_t bytes) { return big_endian(take(bytes), 0, bytes); }

private:
    std::span<const std::byte> rest_;
    const char* fault_;
};

}  // namespace limn
