// Implements the image codec without OpenImageIO: writes PNG and HDR with stb, and reads what decode_stb.h reads.
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#include <stb_image_write.h>

#include <algorithm>
#include <cstring>

#include "io/decode_stb.h"
#include "io/image_codec.h"
#include "io/picture_checks.h"
#include "limn/math/error.h"

namespace limn {

namespace {

// Appends bytes to the vector `context`. stb calls this function to write.
void append(void* context, void* data, int size) {
    const auto* begin = static_cast<const std::byte*>(data);
    auto* bytes = static_cast<std::vector<std::byte>*>(context);
    bytes->insert(bytes->end(), begin, begin + size);
}

void insert(std::vector<std::byte>& bytes, std::ptrdiff_t place, const std::string& text) {
    const std::span<const std::byte> inserted = std::as_bytes(std::span(text));
    bytes.insert(bytes.begin() + place, inserted.begin(), inserted.end());
}

// Returns the bytes of a PNG; none if there is not enough memory.
std::vector<std::byte> encode_png(const EncodeJob& job, const std::uint8_t* values) {
    std::vector<std::byte> bytes;
    const int channels = job.colours();
    if (!stbi_write_png_to_func(append, &bytes, job.width, job.height, channels, values, channels * job.width))
        return {};
    // Insert an sRGB chunk, with perceptual as the rendering intent, and a text chunk for each fact.
    std::string chunks = png_chunk("sRGB", std::string(1, '\0'));
    for (const auto& [name, value] : job.facts) chunks += png_chunk("tEXt", kFactPrefix + name + '\0' + value);
    insert(bytes, kPngHeaderEnd, chunks);
    return bytes;
}

// Returns a fact as a comment line of an HDR's header. Line breaks in it become blanks.
std::string hdr_comment(const std::string& name, std::string value) {
    std::replace(value.begin(), value.end(), '\n', ' ');
    return std::string("# ") + kFactPrefix + name + "=" + value + "\n";
}

// Returns the bytes of an HDR; none if there is not enough memory.
std::vector<std::byte> encode_hdr(const EncodeJob& job, const float* values) {
    std::vector<std::byte> bytes;
    if (!stbi_write_hdr_to_func(append, &bytes, job.width, job.height, 3, values)) return {};
    // Insert the facts after the first line.
    std::string comments;
    for (const auto& [name, value] : job.facts) comments += hdr_comment(name, value);
    insert(bytes, std::find(bytes.begin(), bytes.end(), std::byte{'\n'}) + 1 - bytes.begin(), comments);
    return bytes;
}

Facts read_hdr_facts(std::string_view file) {
    const std::string beginning = std::string("# ") + kFactPrefix;
    Facts facts;
    std::size_t start = 0;
    for (std::size_t end; (end = file.find('\n', start)) != std::string_view::npos && end > start; start = end + 1) {
        const std::string_view line = file.substr(start, end - start);
        const std::size_t equals = line.find('=');
        if (line.starts_with(beginning) && equals != std::string_view::npos)
            facts.emplace_back(line.substr(beginning.size(), equals - beginning.size()), line.substr(equals + 1));
    }
    return facts;
}

Facts read_png_facts(std::span<const std::byte> file) {
    const std::string_view prefix = kFactPrefix;
    Facts facts;
    for (const PngChunk& chunk : png_header_chunks(file))
        if (const std::size_t end = chunk.data.find('\0');
            chunk.type == "tEXt" && chunk.data.starts_with(prefix) && end != std::string_view::npos)
            facts.emplace_back(chunk.data.substr(prefix.size(), end - prefix.size()), chunk.data.substr(end + 1));
    return facts;
}

void require_readable(FileFormat format, const std::string& path) {
    const PictureFormat& row = row_of(format);
    if (!row.stb)
        throw FileError(path, "is " + std::string(row.kind) + ", which this build, without OpenImageIO, cannot read");
}

}  // namespace

bool can_encode(FileFormat format) { return format == FileFormat::png || format == FileFormat::hdr; }

std::vector<std::byte> encode(const EncodeJob& job, const std::string& path) {
    // stb counts bytes in an int. Packing may make the picture somewhat larger, so the limit is a little below 2^31.
    if (static_cast<double>(job.width) * job.height * job.colours() > 2e9)
        throw FileError(path, "this build, without OpenImageIO, cannot write a picture of more than 2e9 values");
    const std::vector<std::byte> bytes =
        job.format == FileFormat::png ? encode_png(job, std::get<std::span<const std::uint8_t>>(job.values).data())
                                      : encode_hdr(job, std::get<std::span<const float>>(job.values).data());
    if (bytes.empty()) throw FileError(path, "there is not enough memory to write it");
    return bytes;
}

StoredImage decode(FileFormat format, std::span<const std::byte> bytes, const std::string& path, int most) {
    require_readable(format, path);
    return decode_stb(format, bytes, path, most);
}

ImageInfo decode_header(FileFormat format, std::span<const std::byte> bytes, const std::string& path) {
    require_readable(format, path);
    ImageInfo info = decode_info_stb(format, bytes, path);
    if (format == FileFormat::hdr) info.facts = read_hdr_facts(text_of(bytes));
    if (format == FileFormat::png) info.facts = read_png_facts(bytes);
    return info;
}

}  // namespace limn
