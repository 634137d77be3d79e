#include "io/image_checks.h"

#include <unistd.h>

#include "io/bytes.h"
#include "io/file_kind.h"
#include "limn/math/error.h"

namespace limn {

namespace {

std::string size_text(int width, int height) { return std::to_string(width) + " x " + std::to_string(height); }

}  // namespace

FileFormat require_sound(std::span<const std::byte> file, const std::string& path) {
    const FileKind kind = kind_of_contents(text_of(file));
    std::string known;
    for (const PictureFormat& row : kPictureFormats) {
        if (!row.format) continue;
        known += (known.empty() ? "" : ", ") + row.name();
        if (kind.format != row.format) continue;
        try {
            row.check(file);
        } catch (const Fault& fault) {
            throw FileError(path, "is not a whole " + row.name() + ": " + fault.text);
        }
        return *row.format;
    }
    const std::string name(file.empty() ? "an empty file" : kind.name);
    throw FileError(path, "is not a readable image: " + (name.empty() ? "" : "it appears to be " + name + "; ") +
                              "those that are read are " + known);
}

void require_possible_size(int width, int height, int channels, std::size_t file_bytes, const std::string& path) {
    if (width <= 0 || height <= 0 || channels <= 0) throw FileError(path, "is not a picture with at least one pixel");
    // Compare the size of the pixels with that of the file. The bound is generous: deflate packs 1032 to 1 at best. Up
    // to a gibibyte of pixels, leave it to the decoder to notice that the file is too short.
    constexpr double kHarmless = 1 << 30, kBestPacking = 5000;
    const double pixels = static_cast<double>(width) * height, bytes = pixels * channels * 4;
    if (bytes > kHarmless && bytes > kBestPacking * static_cast<double>(file_bytes))
        throw FileError(path, "is too short for a picture of " + size_text(width, height));
    // Compare them with the physical memory: 16 bytes a pixel, as stored and as float RGB. An allocation would not
    // fail, because Linux grants memory that it does not have and kills the process that uses it.
    const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
    if (memory > 0 && pixels * 16 > memory)
        throw FileError(path, "there is not enough memory for its " + size_text(width, height) + " pixels");
}

}  // namespace limn
