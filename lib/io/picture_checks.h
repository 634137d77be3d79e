// The headers of picture files, held against the file before any decoder believes them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace limn {

// What keeps a file from being read. Thrown by the checks below, and named with its file by io/image_checks.h.
struct Fault {
    std::string text;
};

inline void demand(bool holds, std::string_view fault) {
    if (!holds) throw Fault{std::string(fault)};
}

inline constexpr const char *kBreaksOff = "it breaks off before its end", *kNoPixels = "it has no pixels";

inline std::string too_short_for(std::uint64_t width, std::uint64_t height) {
    return "it is too short for a picture of " + std::to_string(width) + " x " + std::to_string(height);
}

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

// A header that makes no sense or is of a kind that is not read, or a picture that the file cannot hold. \throws Fault
void check_hdr(std::span<const std::byte> file);
void check_bmp(std::span<const std::byte> file);
void check_tga(std::span<const std::byte> file);

// A TGA has no mark of its own: every field of its header must be one that the format knows.
bool looks_like_tga(std::span<const std::byte> file);

// OpenEXR allocates what an attribute's size says: an attribute that is larger than the file, a picture or a table of
// chunks that the file cannot hold, deep samples. Chunks are not looked at. \throws Fault
void check_exr(std::span<const std::byte> file);

// A JPEG is one from its first marker to its last, with tables that fit their arrays and a size that the file can hold.
// \throws Fault
void check_jpeg(std::span<const std::byte> file);

// A PNG is one from its first chunk to its last, with every checksum right. \throws Fault
void check_png(std::span<const std::byte> file);

struct PngChunk {
    std::string_view type, data;
    std::span<const std::byte> type_and_data;
    std::uint64_t stated_crc;
};

// The chunks before the pixels of a PNG that was found sound. stb reads neither what its colours mean nor its text.
std::vector<PngChunk> png_header_chunks(std::span<const std::byte> file);

// A chunk's bytes, and the place for more of them behind the first one, the image header.
std::string png_chunk(const std::string& type, const std::string& data);
inline constexpr std::ptrdiff_t kPngHeaderEnd = 8 + 4 + 4 + 13 + 4;

}  // namespace limn
