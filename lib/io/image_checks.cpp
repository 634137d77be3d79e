#include "io/image_checks.h"

#include <unistd.h>

#include "io/exr_header.h"
#include "io/file_kind.h"
#include "io/jpeg_segments.h"
#include "io/plain_headers.h"
#include "io/png_chunks.h"
#include "limn/core/error.h"

namespace limn {

namespace {

std::string size_text(int width, int height) { return std::to_string(width) + " x " + std::to_string(height); }

struct Format {
    FileFormat format;
    const char* name;
    std::string (*fault)(std::span<const std::byte>);
};

constexpr Format kFormats[] = {{FileFormat::exr, "EXR", exr_fault},    {FileFormat::png, "PNG", png_fault},
                               {FileFormat::jpeg, "JPEG", jpeg_fault}, {FileFormat::hdr, "HDR", hdr_fault},
                               {FileFormat::bmp, "BMP", bmp_fault},    {FileFormat::tga, "TGA", tga_fault}};

}  // namespace

FileFormat require_sound(std::span<const std::byte> file, const std::string& path) {
    const FileKind kind = kind_of_contents({reinterpret_cast<const char*>(file.data()), file.size()});
    std::string known;
    for (const Format& format : kFormats) {
        known += (known.empty() ? "" : ", ") + std::string(format.name);
        if (kind.format != format.format) continue;
        const std::string fault = format.fault(file);
        if (!fault.empty()) throw FileError(path, "is not a whole " + std::string(format.name) + ": " + fault);
        return format.format;
    }
    const std::string name(file.empty() ? "an empty file" : kind.name);
    throw FileError(path, "is not a readable image: " + (name.empty() ? "" : "it appears to be " + name + "; ") +
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
