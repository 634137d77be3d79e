#include "io/image_checks.h"

#include <unistd.h>

#include <string_view>

#include "io/exr_header.h"
#include "io/file_kind.h"
#include "io/jpeg_segments.h"
#include "io/plain_headers.h"
#include "io/png_chunks.h"
#include "limn/core/error.h"

namespace limn {

namespace {

std::string_view text_of(std::span<const std::byte> file) {
    return {reinterpret_cast<const char*>(file.data()), file.size()};
}

std::string size_text(int width, int height) { return std::to_string(width) + " x " + std::to_string(height); }

struct Format {
    FileFormat format;
    const char* name;
    bool (*fits)(std::span<const std::byte>);
    std::string (*fault)(std::span<const std::byte>);
};

template <const char* mark>
bool begins_with(std::span<const std::byte> file) {
    return text_of(file).starts_with(mark);
}

constexpr char kExr[] = "\x76\x2f\x31\x01", kPng[] = "\x89PNG", kJpeg[] = "\xff\xd8", kHdr[] = "#?", kBmp[] = "BM";

// TGA last, for it has no mark.
constexpr Format kFormats[] = {
    {FileFormat::exr, "EXR", begins_with<kExr>, exr_fault},     {FileFormat::png, "PNG", begins_with<kPng>, png_fault},
    {FileFormat::jpeg, "JPEG", begins_with<kJpeg>, jpeg_fault}, {FileFormat::hdr, "HDR", begins_with<kHdr>, hdr_fault},
    {FileFormat::bmp, "BMP", begins_with<kBmp>, bmp_fault},     {FileFormat::tga, "TGA", looks_like_tga, tga_fault}};

}  // namespace

FileFormat require_sound(std::span<const std::byte> file, const std::string& path) {
    std::string known;
    for (const Format& format : kFormats) {
        if (!format.fits(file)) {
            known += (known.empty() ? "" : ", ") + std::string(format.name);
            continue;
        }
        const std::string fault = format.fault(file);
        if (!fault.empty()) throw FileError(path, "is not a whole " + std::string(format.name) + ": " + fault);
        return format.format;
    }
    const std::string kind = file.empty() ? "an empty file" : kind_of_contents(text_of(file));
    throw FileError(path, "is not a readable image: " + (kind.empty() ? "" : "it appears to be " + kind + "; ") +
                              "those that are read are " + known);
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
