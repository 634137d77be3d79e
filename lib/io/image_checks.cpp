#include "io/image_checks.h"

#include <unistd.h>

#include <string_view>

#include "io/png_chunks.h"
#include "limn/core/error.h"

namespace limn {

namespace {

std::string_view text_of(std::span<const std::byte> file) {
    return {reinterpret_cast<const char*>(file.data()), file.size()};
}

std::string size_text(int width, int height) { return std::to_string(width) + " x " + std::to_string(height); }

std::size_t byte_at(std::span<const std::byte> bytes, std::size_t place) {
    return std::to_integer<std::size_t>(bytes[place]);
}

// Huffman tables (ITU-T T.81, B.2.4.2): each a byte, the numbers of codes of 1 to 16 bits, and the codes' values, at
// most 256. stb writes beyond its array where there are more.
bool are_huffman_tables(std::span<const std::byte> data) {
    while (!data.empty()) {
        if (data.size() < 17) return false;
        std::size_t codes = 0;
        for (std::size_t i = 1; i <= 16; ++i) codes += byte_at(data, i);
        if (codes > 256 || codes > data.size() - 17) return false;
        data = data.subspan(17 + codes);
    }
    return true;
}

// ITU-T T.81, B.1.1: segments of a marker and, but for a few, a length with data; scans go on until the next marker.
std::string jpeg_fault(std::span<const std::byte> file) {
    constexpr std::size_t kHuffman = 0xc4, kFirstRestart = 0xd0, kLastRestart = 0xd7, kEnd = 0xd9, kScan = 0xda;
    bool has_scan = false;
    for (std::size_t place = 2; place + 2 <= file.size();) {
        if (byte_at(file, place) != 0xff) return "there is no marker where one must be";
        const std::size_t marker = byte_at(file, place + 1);
        if (marker == 0xff) {  // fills
            ++place;
            continue;
        }
        if (marker == kEnd) return has_scan ? "" : "it has no pixels";
        if (place + 4 > file.size()) break;
        const std::size_t length = 256 * byte_at(file, place + 2) + byte_at(file, place + 3);
        if (length < 2 || length > file.size() - place - 2) break;
        if (marker == kHuffman && !are_huffman_tables(file.subspan(place + 4, length - 2)))
            return "a Huffman table is damaged";
        place += 2 + length;
        if (marker != kScan) continue;
        has_scan = true;
        const auto is_data = [&](std::size_t i) {
            if (byte_at(file, i) != 0xff) return true;
            const std::size_t next = byte_at(file, i + 1);
            return next == 0 || (next >= kFirstRestart && next <= kLastRestart);
        };
        while (place + 1 < file.size() && is_data(place)) ++place;
    }
    return "it breaks off before its end";
}

}  // namespace

std::optional<FileFormat> format_of_contents(std::span<const std::byte> file) {
    const std::string_view text = text_of(file);
    if (text.starts_with("\x76\x2f\x31\x01")) return FileFormat::exr;
    if (text.starts_with("\x89PNG")) return FileFormat::png;
    if (text.starts_with("\xff\xd8")) return FileFormat::jpeg;
    if (text.starts_with("#?")) return FileFormat::hdr;
    return std::nullopt;
}

void require_whole(std::span<const std::byte> file, const std::string& path) {
    const auto format = format_of_contents(file);
    if (format == FileFormat::png) {
        const std::string fault = png_fault(file);
        if (!fault.empty()) throw FileError(path, "is not a whole PNG: " + fault);
    }
    if (format == FileFormat::jpeg) {
        const std::string fault = jpeg_fault(file);
        if (!fault.empty()) throw FileError(path, "is not a whole JPEG: " + fault);
    }
}

void require_possible_size(int width, int height, int channels, std::size_t file_bytes, const std::string& path) {
    if (width <= 0 || height <= 0 || channels <= 0) throw FileError(path, "is not a picture with at least one pixel");
    // Deflate packs 1032 to 1 at best. Up to a gibibyte the reader finds out by itself.
    constexpr double kHarmless = 1 << 30, kBestPacking = 5000;
    const double pixels = static_cast<double>(width) * height, bytes = pixels * channels * 4;
    if (bytes > kHarmless && bytes > kBestPacking * static_cast<double>(file_bytes))
        throw FileError(path, "is too short for a picture of " + size_text(width, height));
    // As stored and as float RGB. Linux grants memory that it does not have, and kills who uses it.
    const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
    if (memory > 0 && pixels * 16 > memory)
        throw FileError(path, "there is not enough memory for its " + size_text(width, height) + " pixels");
}

}  // namespace limn
