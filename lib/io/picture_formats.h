// The table of picture formats. A new format that limn reads is an enumerator and a row here, and the function that
// checks a file of it, in a source of its own.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace limn {

enum class FileFormat { exr, png, jpeg, hdr, bmp, tga };

// These check a file before a library decodes it, and throw a Fault if it is not sound: its header must be valid and of
// a kind that limn reads, and the file must be able to hold the picture. For EXR the chunks are not checked. For JPEG
// and PNG everything is checked from the first segment or chunk to the last, with the checksums of a PNG.
void check_exr(std::span<const std::byte> file);
void check_png(std::span<const std::byte> file);
void check_jpeg(std::span<const std::byte> file);
void check_hdr(std::span<const std::byte> file);
void check_bmp(std::span<const std::byte> file);
void check_tga(std::span<const std::byte> file);

// These recognise formats without a mark. The fields of a TGA's header must have values that TGA allows.
bool looks_like_pnm(std::span<const std::byte> file);
bool looks_like_tga(std::span<const std::byte> file);

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

// A row of the table. Formats that limn does not read have only marks, by which errors name them.
struct PictureFormat {
    std::string_view kind;                                     // "a PNG picture"
    std::array<Mark, 3> marks{};                               // those without a beginning don't count
    bool (*looks_like)(std::span<const std::byte>) = nullptr;  // recognises a format without a mark

    std::optional<FileFormat> format{};                   // unset if limn does not read the format
    const char* name = nullptr;                           // "PNG"
    void (*check)(std::span<const std::byte>) = nullptr;  // see above
    const char* suffix = nullptr;                         // of the names of pictures that are written; null: none is
    const char* openimageio = nullptr;                    // OpenImageIO's name of the format; null: stb decodes it
    bool stb = true;                                      // false if stb cannot decode the format
};

// OpenImageIO 2.4 has errors in three formats, which stb therefore decodes in every build: it reads outside of the
// palette of a damaged TGA, takes the unused bytes of a BMP for alpha, and reads the numbers of an HDR in the locale of
// the C library. AVIF and HEIF begin with the size of a box in four bytes.
inline constexpr PictureFormat kPictureFormats[] = {
    {.kind = "an EXR picture",
     .marks = {{{"\x76\x2f\x31\x01"}}},
     .format = FileFormat::exr,
     .name = "EXR",
     .check = check_exr,
     .suffix = ".exr",
     .openimageio = "openexr",
     .stb = false},
    {.kind = "a PNG picture",
     .marks = {{{"\x89PNG"}}},
     .format = FileFormat::png,
     .name = "PNG",
     .check = check_png,
     .suffix = ".png",
     .openimageio = "png"},
    {.kind = "a JPEG picture",
     .marks = {{{"\xff\xd8"}}},
     .format = FileFormat::jpeg,
     .name = "JPEG",
     .check = check_jpeg,
     .openimageio = "jpeg"},
    {.kind = "an HDR picture",
     .marks = {{{"#?RADIANCE"}, {"#?RGBE"}, {.beginning = "#?", .may_be_text = true}}},
     .format = FileFormat::hdr,
     .name = "HDR",
     .check = check_hdr,
     .suffix = ".hdr"},
    {.kind = "a BMP picture",
     .marks = {{{"BM", 6, {"\0\0\0\0", 4}}, {.beginning = "BM", .may_be_text = true}}},
     .format = FileFormat::bmp,
     .name = "BMP",
     .check = check_bmp},
    {.kind = "a TGA picture",
     .looks_like = looks_like_tga,
     .format = FileFormat::tga,
     .name = "TGA",
     .check = check_tga},
    {.kind = "a PNM picture", .looks_like = looks_like_pnm},
    {.kind = "a GIF picture", .marks = {{{"GIF8"}}}},
    {.kind = "a TIFF picture", .marks = {{{{"II*\0", 4}}, {{"MM\0*", 4}}}}},
    {.kind = "a Photoshop picture", .marks = {{{"8BPS"}}}},
    {.kind = "a DDS picture", .marks = {{{"DDS "}}}},
    {.kind = "a KTX picture", .marks = {{{"\xabKTX"}}}},
    {.kind = "a QOI picture", .marks = {{{"qoif"}}}},
    {.kind = "a JPEG XL picture", .marks = {{{"\xff\x0a"}, {{"\0\0\0\x0cJXL ", 8}}}}},
    {.kind = "a JPEG 2000 picture", .marks = {{{"\xff\x4f\xff\x51"}, {{"\0\0\0\x0cjP  ", 8}}}}},
    {.kind = "a WebP picture", .marks = {{{"RIFF", 8, "WEBP"}}}},
    {.kind = "an AVIF picture", .marks = {{{{"\0\0", 2}, 4, "ftypavif"}}}},
    {.kind = "a HEIF picture", .marks = {{{{"\0\0", 2}, 4, "ftyphei"}, {{"\0\0", 2}, 4, "ftypmif1"}}}},
};

// Returns the row of a format.
constexpr const PictureFormat& row_of(FileFormat format) {
    return *std::ranges::find(kPictureFormats, std::optional(format), &PictureFormat::format);
}

}  // namespace limn
