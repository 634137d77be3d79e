#include "io/file_kind.h"

#include <algorithm>
#include <cstddef>

namespace limn {

namespace {

using namespace std::string_view_literals;

struct Mark {
    std::size_t place;
    std::string_view bytes;
    const char* kind;
};

// The first that fits. UTF-32 begins with the mark of UTF-16.
constexpr Mark kMarks[] = {
    {0, "\xff\xfe\0\0"sv, "UTF-32 text"},
    {0, "\0\0\xfe\xff"sv, "UTF-32 text"},
    {0, "\xff\xfe"sv, "UTF-16 text"},
    {0, "\xfe\xff"sv, "UTF-16 text"},
    {0, "\x89PNG"sv, "a PNG picture"},
    {0, "\xff\xd8\xff"sv, "a JPEG picture"},
    {0, "\x76\x2f\x31\x01"sv, "an EXR picture"},
    {0, "#?RADIANCE"sv, "an HDR picture"},
    {0, "#?RGBE"sv, "an HDR picture"},
    {0, "GIF8"sv, "a GIF picture"},
    {0, "II*\0"sv, "a TIFF picture"},
    {0, "MM\0*"sv, "a TIFF picture"},
    {0, "8BPS"sv, "a Photoshop picture"},
    {0, "DDS "sv, "a DDS picture"},
    {0, "\xabKTX"sv, "a KTX picture"},
    {0, "qoif"sv, "a QOI picture"},
    {0, "\xff\x0a"sv, "a JPEG XL picture"},
    {0, "\xff\x4f\xff\x51"sv, "a JPEG 2000 picture"},
    {4, "JXL "sv, "a JPEG XL picture"},
    {4, "jP  "sv, "a JPEG 2000 picture"},
    {8, "WEBP"sv, "a WebP picture"},
    {4, "ftypavif"sv, "an AVIF picture"},
    {4, "ftyphei"sv, "a HEIF picture"},
    {4, "ftypmif1"sv, "a HEIF picture"},
    {0, "ply\n"sv, "a PLY model"},
    {0, "ply\r"sv, "a PLY model"},
    {0, "glTF"sv, "a binary glTF model"},
    {0, "Kaydara FBX Binary"sv, "an FBX model"},
    {0, "; FBX"sv, "an FBX model"},
    {0, "BLENDER"sv, "a Blender file"},
    {0, "PK\3\4"sv, "a ZIP archive"},
    {0, "\x1f\x8b"sv, "a file packed by gzip"},
    {0, "%PDF"sv, "a PDF document"},
    {0, "\177ELF"sv, "a program"},
    {0, "<svg"sv, "an SVG picture"},
    {0, "<!DOCTYPE html"sv, "an HTML page"},
    {0, "<html"sv, "an HTML page"},
    {0, "<?xml"sv, "an XML document"},
};

bool has(std::string_view contents, const Mark& mark) {
    return contents.size() >= mark.place && contents.substr(mark.place).starts_with(mark.bytes);
}

bool is_pnm(std::string_view contents) {
    return contents.size() > 2 && contents[0] == 'P' && contents[1] >= '1' && contents[1] <= '7' &&
           (contents[2] == '\n' || contents[2] == ' ' || contents[2] == '\r');
}

// 80 bytes of any text, the number of triangles, and 50 bytes for each.
bool is_binary_stl(std::string_view contents) {
    if (contents.size() < 84) return false;
    std::size_t triangles = 0;
    for (std::size_t i = 84; i-- > 80;) triangles = triangles << 8 | static_cast<unsigned char>(contents[i]);
    return triangles > 0 && contents.size() == 84 + 50 * triangles;
}

// Without a byte order mark: every other byte of Latin text is zero.
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

std::string kind_of_contents(std::string_view contents) {
    if (contents.starts_with("BM") && contents.substr(2).size() > 12 && contents.substr(6, 4) == "\0\0\0\0"sv)
        return "a BMP picture";  // four bytes are reserved, and text has no zeros
    for (const Mark& mark : kMarks)
        if (has(contents, mark)) return mark.kind;
    if (is_pnm(contents)) return "a PNM picture";
    if (contents.starts_with("solid") && contents.substr(0, 1000).find("facet") != std::string_view::npos)
        return "an STL model";
    if (is_binary_stl(contents)) return "an STL model";
    const std::size_t first = contents.find_first_not_of(" \t\r\n");
    if (first != std::string_view::npos && contents[first] == '{')
        return contents.find("\"asset\"") != std::string_view::npos ? "a glTF model" : "JSON text";
    return is_utf16(contents) ? "UTF-16 text" : "";
}

}  // namespace limn
