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
    const std::string_view text = text_of(file);
    const auto format = format_of_contents(file);
    if (format == FileFormat::png) {
        const std::string fault = png_fault(file);
        if (!fault.empty()) throw FileError(path, "is not a whole PNG: " + fault);
    }
    if (format == FileFormat::jpeg) {
        // ITU-T T.81, table B.1: neither marker, start of scan or end of image, occurs within the data of a scan.
        const std::size_t scan = text.rfind("\xff\xda"), end = text.rfind("\xff\xd9");
        if (end == std::string_view::npos || scan == std::string_view::npos || scan > end)
            throw FileError(path, "is an image that breaks off before its end");
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
