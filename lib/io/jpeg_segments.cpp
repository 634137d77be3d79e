#include <algorithm>
#include <cstdint>

#include "io/picture_checks.h"

namespace limn {

namespace {

// The second bytes of markers (ITU-T T.81, table B.1). The sections below are those of T.81.
constexpr std::uint64_t kFirstFrame = 0xc0, kLastFrame = 0xcf, kProgressive = 0xc2;
constexpr std::uint64_t kHuffman = 0xc4, kExtension = 0xc8, kArithmetic = 0xcc;
constexpr std::uint64_t kFirstRestart = 0xd0, kLastRestart = 0xd7;
constexpr std::uint64_t kStart = 0xd8, kEnd = 0xd9, kScan = 0xda;
constexpr std::uint64_t kTemporary = 0x01, kFill = 0xff;

std::uint64_t byte_at(std::span<const std::byte> bytes, std::size_t place) {
    return std::to_integer<std::uint64_t>(bytes[place]);
}

// Returns true if the marker begins the header of a frame.
bool is_frame(std::uint64_t marker) {
    return marker >= kFirstFrame && marker <= kLastFrame && marker != kHuffman && marker != kExtension &&
           marker != kArithmetic;
}

// Returns true if a length and data follow the marker.
bool has_length(std::uint64_t marker) {
    return marker > kTemporary && !(marker >= kFirstRestart && marker <= kLastRestart) && marker != kStart;
}

// Checks Huffman tables (B.2.4.2). A table is one byte, the numbers of codes of 1 to 16 bits, and the values of the
// codes. There are at most 256 codes; with more, stb would write beyond its array. \throws Fault
void check_huffman_tables(std::span<const std::byte> data) {
    constexpr const char* kDamaged = "a Huffman table is damaged";
    for (Cursor tables(data, kDamaged); !tables.rest().empty();) {
        std::size_t codes = 0;
        for (const std::byte count : tables.take(17).subspan(1)) codes += std::to_integer<std::size_t>(count);
        demand(codes <= 256, kDamaged);
        tables.take(codes);
    }
}

// Checks the header of a frame (B.2.2): the precision, height, width, and for each component an identifier, the
// sampling factors and a quantisation table. Checks that a file of `file_bytes` bytes can hold the picture: as a
// Huffman code, each block of 8 x 8 values takes at least one bit. \throws Fault
void check_frame(std::uint64_t marker, std::span<const std::byte> data, std::size_t file_bytes) {
    demand(data.size() >= 6 && data.size() == 6 + 3 * byte_at(data, 5), "its size is damaged");
    const std::uint64_t height = big_endian(data, 1, 2), width = big_endian(data, 3, 2), count = byte_at(data, 5);
    demand(height > 0 && width > 0 && count > 0, kNoPixels);
    // Find the largest sampling factors, and the number of blocks in a minimum coded unit.
    std::uint64_t most_x = 0, most_y = 0, blocks = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint64_t factors = byte_at(data, 6 + 3 * i + 1), x = factors >> 4, y = factors & 15;
        demand(x >= 1 && x <= 4 && y >= 1 && y <= 4, "its sampling is damaged");
        most_x = std::max(most_x, x);
        most_y = std::max(most_y, y);
        blocks += x * y;
    }
    // Count the blocks of the picture.
    const auto units = [](std::uint64_t size, std::uint64_t factor) { return (size + 8 * factor - 1) / (8 * factor); };
    blocks *= units(width, most_x) * units(height, most_y);
    demand(marker > kProgressive || blocks <= 8 * std::uint64_t{file_bytes}, too_short_for(width, height));
}

// Returns the place of the marker that follows the data of a scan. The data begin at `place`. A run of 0xff followed by
// zero or by the second byte of a restart marker belongs to the data. Decoders find the end in the same way.
std::size_t end_of_scan(std::span<const std::byte> file, std::size_t place) {
    while (place + 1 < file.size()) {
        std::size_t next = place;
        while (next < file.size() && byte_at(file, next) == kFill) ++next;
        if (next == file.size()) break;
        const std::uint64_t marker = byte_at(file, next);
        if (next > place && marker != 0 && !(marker >= kFirstRestart && marker <= kLastRestart)) break;
        place = next + 1;
    }
    return place;
}

}  // namespace

// A JPEG is a sequence of segments (B.1.1). A segment is a marker and, for most markers, a length and data. After the
// segment that begins a scan, the data of the scan extend to the next marker.
void check_jpeg(std::span<const std::byte> file) {
    bool has_frame = false, has_scan = false;
    for (std::size_t place = 2; place + 2 <= file.size();) {
        // Read a marker. Any number of fill bytes may precede it.
        demand(byte_at(file, place) == kFill, "there is no marker where one must be");
        const std::uint64_t marker = byte_at(file, place + 1);
        if (marker == kFill) {
            ++place;
            continue;
        }
        if (marker == kEnd) return demand(has_scan, kNoPixels);
        demand(has_length(marker), "there is a marker where it must not be");
        // Read its data.
        if (place + 4 > file.size()) break;
        const std::uint64_t length = big_endian(file, place + 2, 2);
        if (length < 2 || length > file.size() - place - 2) break;
        const std::span<const std::byte> data = file.subspan(place + 4, length - 2);
        place += 2 + length;
        // Check tables and frames.
        if (marker == kHuffman) check_huffman_tables(data);
        if (is_frame(marker)) {
            demand(!has_frame, "it has two sizes");
            has_frame = true;
            check_frame(marker, data, file.size());
        }
        // Skip the data of a scan.
        if (marker != kScan) continue;
        demand(has_frame, "it has pixels before its size");
        has_scan = true;
        place = end_of_scan(file, place);
    }
    throw Fault{kBreaksOff};
}

}  // namespace limn
