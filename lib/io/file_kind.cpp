#include "io/file_kind.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "io/bytes.h"
#include "io/text_lines.h"

namespace limn {

namespace {

using namespace std::string_view_literals;

struct MarkedKind {
    Mark mark;
    FileKind kind;
};

constexpr FileKind kPly{"a PLY model", {}, false, ModelFormat::ply};
constexpr FileKind kStl{"an STL model", {}, false, ModelFormat::stl};

// The kinds that are no pictures. The first mark that fits decides. UTF-32 is before UTF-16 because its mark begins
// with the mark of UTF-16.
constexpr MarkedKind kMarkedKinds[] = {
    {{"\xff\xfe\0\0"sv}, {"UTF-32 text"}},
    {{"\0\0\xfe\xff"sv}, {"UTF-32 text"}},
    {{"\xff\xfe"sv}, {"UTF-16 text"}},
    {{"\xfe\xff"sv}, {"UTF-16 text"}},
    {{"ply\n"sv}, kPly},
    {{"ply\r"sv}, kPly},
    {{"ply "sv, 3, " \n"sv}, kPly},
    {{"ply "sv, 3, " \r"sv}, kPly},
    {{"glTF"sv}, {"a binary glTF model", {}, false, ModelFormat::gltf}},
    {{"Kaydara FBX Binary"sv}, {"an FBX model"}},
    {{"; FBX"sv}, {"an FBX model"}},
    {{"BLENDER"sv}, {"a Blender file"}},
    {{"PK\3\4"sv}, {"a ZIP archive"}},
    {{"\x1f\x8b"sv}, {"a file packed by gzip"}},
    {{"%PDF"sv}, {"a PDF document"}},
    {{"\177ELF"sv}, {"a program"}},
    {{"<svg"sv}, {"an SVG picture"}},
    {{"<!DOCTYPE html"sv}, {"an HTML page"}},
    {{"<html"sv}, {"an HTML page"}},
    {{"<?xml"sv}, {"an XML document"}},
};

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
    // Test for a binary STL first: its header may hold anything, also the mark of another format.
    if (is_binary_stl(contents)) return kStl;
    // Test for kinds with marks.
    for (const PictureFormat& picture : kPictureFormats)
        for (const Mark& mark : picture.marks)
            if (!mark.beginning.empty() && mark.fits(contents)) return {picture.kind, picture.format, mark.may_be_text};
    for (const auto& [mark, kind] : kMarkedKinds)
        if (mark.fits(contents)) return kind;
    // Test for kinds without marks. A text in UTF-16 may look like a TGA.
    if (is_ascii_stl(contents)) return kStl;
    if (is_utf16(contents)) return {"UTF-16 text"};
    for (const PictureFormat& picture : kPictureFormats)
        if (picture.looks_like != nullptr && picture.looks_like(std::as_bytes(std::span(contents))))
            return {picture.kind, picture.format};
    // A glTF is a JSON object with the member "asset".
    if (contents.starts_with(kByteOrderMark)) contents.remove_prefix(kByteOrderMark.size());
    const std::size_t first = contents.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos || contents[first] != '{') return {};
    if (contents.find("\"asset\"") == std::string_view::npos) return {"JSON text"};
    return {"a glTF model", {}, false, ModelFormat::gltf};
}

}  // namespace limn
