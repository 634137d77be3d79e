#include "io/file_kind.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "io/picture_checks.h"
#include "io/text_lines.h"

namespace limn {

namespace {

using namespace std::string_view_literals;

// The bytes by which a kind of file is recognised: `beginning` at its start and `also` at byte `place`. `also` never
// decides alone, because a text might have the same bytes there.
struct Mark {
    std::string_view beginning;
    FileKind kind;
    std::size_t place = 0;
    std::string_view also{};
};

constexpr bool kMayBeText = true;

// The first mark that fits decides. UTF-32 is before UTF-16 because its mark begins with the mark of UTF-16. AVIF and
// HEIF begin with the size of a box in four bytes.
constexpr Mark kMarks[] = {
    {"\xff\xfe\0\0"sv, {"UTF-32 text"}},
    {"\0\0\xfe\xff"sv, {"UTF-32 text"}},
    {"\xff\xfe"sv, {"UTF-16 text"}},
    {"\xfe\xff"sv, {"UTF-16 text"}},
    {"\x89PNG"sv, {"a PNG picture", FileFormat::png}},
    {"\xff\xd8"sv, {"a JPEG picture", FileFormat::jpeg}},
    {"\x76\x2f\x31\x01"sv, {"an EXR picture", FileFormat::exr}},
    {"#?RADIANCE"sv, {"an HDR picture", FileFormat::hdr}},
    {"#?RGBE"sv, {"an HDR picture", FileFormat::hdr}},
    {"#?"sv, {"an HDR picture", FileFormat::hdr, kMayBeText}},
    {"BM"sv, {"a BMP picture", FileFormat::bmp}, 6, "\0\0\0\0"sv},
    {"BM"sv, {"a BMP picture", FileFormat::bmp, kMayBeText}},
    {"GIF8"sv, {"a GIF picture"}},
    {"II*\0"sv, {"a TIFF picture"}},
    {"MM\0*"sv, {"a TIFF picture"}},
    {"8BPS"sv, {"a Photoshop picture"}},
    {"DDS "sv, {"a DDS picture"}},
    {"\xabKTX"sv, {"a KTX picture"}},
    {"qoif"sv, {"a QOI picture"}},
    {"\xff\x0a"sv, {"a JPEG XL picture"}},
    {"\xff\x4f\xff\x51"sv, {"a JPEG 2000 picture"}},
    {"\0\0\0\x0cJXL "sv, {"a JPEG XL picture"}},
    {"\0\0\0\x0cjP  "sv, {"a JPEG 2000 picture"}},
    {"RIFF"sv, {"a WebP picture"}, 8, "WEBP"sv},
    {"\0\0"sv, {"an AVIF picture"}, 4, "ftypavif"sv},
    {"\0\0"sv, {"a HEIF picture"}, 4, "ftyphei"sv},
    {"\0\0"sv, {"a HEIF picture"}, 4, "ftypmif1"sv},
    {"ply\n"sv, {"a PLY model", {}, false, ModelFormat::ply}},
    {"ply\r"sv, {"a PLY model", {}, false, ModelFormat::ply}},
    {"ply "sv, {"a PLY model", {}, false, ModelFormat::ply}, 3, " \n"sv},
    {"ply "sv, {"a PLY model", {}, false, ModelFormat::ply}, 3, " \r"sv},
    {"glTF"sv, {"a binary glTF model", {}, false, ModelFormat::gltf}},
    {"Kaydara FBX Binary"sv, {"an FBX model"}},
    {"; FBX"sv, {"an FBX model"}},
    {"BLENDER"sv, {"a Blender file"}},
    {"PK\3\4"sv, {"a ZIP archive"}},
    {"\x1f\x8b"sv, {"a file packed by gzip"}},
    {"%PDF"sv, {"a PDF document"}},
    {"\177ELF"sv, {"a program"}},
    {"<svg"sv, {"an SVG picture"}},
    {"<!DOCTYPE html"sv, {"an HTML page"}},
    {"<html"sv, {"an HTML page"}},
    {"<?xml"sv, {"an XML document"}},
};

bool has(std::string_view contents, const Mark& mark) {
    return contents.starts_with(mark.beginning) && contents.size() >= mark.place &&
           contents.substr(mark.place).starts_with(mark.also);
}

bool is_pnm(std::string_view contents) {
    return contents.size() > 2 && contents[0] == 'P' && contents[1] >= '1' && contents[1] <= '7' &&
           (contents[2] == '\n' || contents[2] == ' ' || contents[2] == '\r');
}

bool is_ascii_stl(std::string_view contents) {
    const auto holds = [beginning = contents.substr(0, 1000)](std::string_view word) {
        return beginning.find(word) != std::string_view::npos;
    };
    return begins_with_solid(contents) && (holds("facet") || holds("FACET") || holds("endsolid"));
}

// Recognises UTF-16 without a byte order mark: in Latin text, every other byte is zero.
bool is_utf16(std::string_view contents) {
    const std::string_view beginning = contents.substr(0, contents.size() < 64 ? contents.size() / 2 * 2 : 64);
    for (const std::size_t zero : {0u, 1u}) {
        bool fits = beginning.size() >= 8;
        for (std::size_t i = 0; i < beginning.size(); ++i) fits = fits && (beginning[i] == '\0') == (i % 2 == zero);
        if (fits) return true;
    }
    return false;
}

}  // namespace

bool is_binary_stl(std::string_view contents) {
    if (contents.size() < kStlHeader) return false;
    const std::uint64_t triangles = little_endian(std::as_bytes(std::span(contents)), 80, 4);
    return triangles > 0 && contents.size() == kStlHeader + kStlTriangle * triangles;
}

bool begins_with_solid(std::string_view contents) {
    std::string_view text = contents.substr(contents.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
    text.remove_prefix(std::min(text.size(), text.find_first_not_of(" \t\r\n")));
    const bool has_word = text.starts_with("solid") || text.starts_with("SOLID") || text.starts_with("Solid");
    return has_word && contents.substr(0, kStlHeader).find('\0') == std::string_view::npos;
}

FileKind kind_of_contents(std::string_view contents) {
    const std::span<const std::byte> bytes = std::as_bytes(std::span(contents));
    constexpr FileKind kStl{"an STL model", {}, false, ModelFormat::stl};
    // Test for a binary STL first: its header may hold anything, also the mark of another format.
    if (is_binary_stl(contents)) return kStl;
    for (const Mark& mark : kMarks)
        if (has(contents, mark)) return mark.kind;
    if (is_pnm(contents)) return {"a PNM picture"};
    if (is_ascii_stl(contents)) return kStl;
    if (is_utf16(contents)) return {"UTF-16 text"};
    if (looks_like_tga(bytes)) return {"a TGA picture", FileFormat::tga};
    // A glTF is a JSON object with the member "asset".
    if (contents.starts_with(kByteOrderMark)) contents.remove_prefix(kByteOrderMark.size());
    const std::size_t first = contents.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos || contents[first] != '{') return {};
    if (contents.find("\"asset\"") == std::string_view::npos) return {"JSON text"};
    return {"a glTF model", {}, false, ModelFormat::gltf};
}

}  // namespace limn
