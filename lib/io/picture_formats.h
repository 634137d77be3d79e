// The table of picture formats. A new format that limn reads is an enumerator and a row here, and the function that
// checks a file of it, in a source of its own.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace limn {

enum class FileFormat { exr, png, jpeg, hdr, bmp, tga };

// These check a file before a library decodes it, and throw a Fault if it is not sound. Its header must be valid and of
// a kind that limn reads, and the file must be large enough for the picture. The chunks of an EXR are not checked. A
// JPEG or a PNG is checked from its first segment or chunk to its last, with the checksums of a PNG.
void check_exr(std::span<const std::byte> file);
void check_png(std::span<const std::byte> file);
void check_jpeg(std::span<const std::byte> file);
void check_hdr(std::span<const std::byte> file);
void check_bmp(std::span<const std::byte> file);
void check_tga(std::span<const std::byte> file);

// These recognise formats without a mark. The fields of a TGA's header must have values that TGA allows.
bool looks_like_pnm(std::span<const std::byte> file);
bool looks_like_tga(std::span<const std::byte> file);

constexpr bool kMayBeText = true;

// The bytes by which a kind of file is recognised: `beginning` at its start and `also` at byte `place`. `also` never
// decides alone, because a text might have the same bytes there.
struct Mark {
    std::string_view beginning{};
    std::size_t place = 0;
    std::string_view also{};
    bool may_be_text = false;  // true if a text may begin with the same bytes

    constexpr bool fits(std::string_view contents) const {
        return contents.starts_with(beginning) && contents.size() >= place && contents.substr(place).starts_with(also);
    }
};

// A row of the table. A format that limn does not read has only marks, so that an error can name the format.
struct PictureFormat {
    std::string_view kind;                                     // "a PNG picture"
    std::array<Mark, 3> marks{};                               // a mark without a beginning is unused
    bool (*looks_like)(std::span<const std::byte>) = nullptr;  // recognises a format without a mark
    std::optional<FileFormat> format{};                        // unset if limn does not read the format
    void (*check)(std::span<const std::byte>) = nullptr;       // see above
    const char* suffix = nullptr;       // ends the names of pictures that limn writes; null if it writes none
    const char* openimageio = nullptr;  // OpenImageIO's name of the format; null if stb decodes it in every build
    bool stb = true;                    // false if stb cannot decode the format

    // Returns "PNG".
    std::string name() const {
        const std::size_t begin = kind.find(' ') + 1;
        return std::string(kind.substr(begin, kind.rfind(' ') - begin));
    }
};

// OpenImageIO 2.4 has errors in three formats, which stb therefore decodes in every build: it reads outside of the
// palette of a damaged TGA, takes the unused bytes of a BMP for alpha, and reads the numbers of an HDR in the locale of
// the C library. AVIF and HEIF begin with the size of a box in four bytes.
inline constexpr PictureFormat kPictureFormats[] = {
    {"an EXR picture", {{{"\x76\x2f\x31\x01"}}}, nullptr, FileFormat::exr, check_exr, ".exr", "openexr", false},
    {"a PNG picture", {{{"\x89PNG"}}}, nullptr, FileFormat::png, check_png, ".png", "png"},
    {"a JPEG picture", {{{"\xff\xd8"}}}, nullptr, FileFormat::jpeg, check_jpeg, nullptr, "jpeg"},
    {"an HDR picture",
     {{{"#?RADIANCE"}, {"#?RGBE"}, {"#?", 0, {}, kMayBeText}}},
     nullptr,
     FileFormat::hdr,
     check_hdr,
     ".hdr"},
    {"a BMP picture", {{{"BM", 6, {"\0\0\0\0", 4}}, {"BM", 0, {}, kMayBeText}}}, nullptr, FileFormat::bmp, check_bmp},
    {"a TGA picture", {}, looks_like_tga, FileFormat::tga, check_tga},
    {"a PNM picture", {}, looks_like_pnm},
    {"a GIF picture", {{{"GIF8"}}}},
    {"a TIFF picture", {{{{"II*\0", 4}}, {{"MM\0*", 4}}}}},
    {"a Photoshop picture", {{{"8BPS"}}}},
    {"a DDS picture", {{{"DDS "}}}},
    {"a KTX picture", {{{"\xabKTX"}}}},
    {"a QOI picture", {{{"qoif"}}}},
    {"a JPEG XL picture", {{{"\xff\x0a"}, {{"\0\0\0\x0cJXL ", 8}}}}},
    {"a JPEG 2000 picture", {{{"\xff\x4f\xff\x51"}, {{"\0\0\0\x0cjP  ", 8}}}}},
    {"a WebP picture", {{{"RIFF", 8, "WEBP"}}}},
    {"an AVIF picture", {{{{"\0\0", 2}, 4, "ftypavif"}}}},
    {"a HEIF picture", {{{{"\0\0", 2}, 4, "ftyphei"}, {{"\0\0", 2}, 4, "ftypmif1"}}}},
};

// Returns the row of a format.
inline const PictureFormat& row_of(FileFormat format) {
    return *std::ranges::find(kPictureFormats, std::optional(format), &PictureFormat::format);
}

}  // namespace limn
