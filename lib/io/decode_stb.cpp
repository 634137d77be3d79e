// Decodes pictures with stb_image. This is the only source that contains stb_image, and its functions are static. stb
// has decoders for formats that limn does not read. They are never called, because require_sound() refuses such files.
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
// stb reads memory that a broken file has left unset. Zeroed memory makes the result the same every time.
#include <cstdlib>
#define STBI_MALLOC(size) std::calloc(1, size)
#define STBI_REALLOC(memory, size) std::realloc(memory, size)
#define STBI_FREE(memory) std::free(memory)
#include <stb_image.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "io/decode_stb.h"
#include "io/image_checks.h"
#include "io/picture_checks.h"
#include "limn/math/error.h"

namespace limn {

namespace {

// Sets the transfer function that a PNG states. An sRGB chunk takes precedence over a gAMA chunk.
void read_png_transfer(std::span<const std::byte> bytes, StoredImage& image) {
    for (const PngChunk& chunk : png_header_chunks(bytes)) {
        if (chunk.type == "sRGB") {
            image.transfer = Transfer::srgb;
        } else if (chunk.type == "gAMA" && chunk.data.size() == 4 && image.transfer == Transfer::unsaid) {
            // The chunk states the exponent of encoding, times 100000 (PNG specification, 11.3.3.2).
            const std::uint64_t gamma = big_endian(chunk.type_and_data, 4, 4);
            if (gamma == 0) continue;
            image.transfer = Transfer::power;
            image.exponent = 100000 / static_cast<double>(gamma);
        }
    }
}

// Gives stb the bytes of a file, and records if stb asks for more than there are. stb itself fills the missing pixels
// with zeros and reports no error.
class Reader {
public:
    Reader(FileFormat format, std::span<const std::byte> bytes) : rest_(bytes), is_hdr_(format == FileFormat::hdr) {}
    bool overran() const { return overran_; }

    static constexpr stbi_io_callbacks callbacks() {
        return {[](void* reader, char* to, int size) { return static_cast<Reader*>(reader)->read(to, size); },
                [](void* reader, int count) { static_cast<Reader*>(reader)->skip(count); },
                [](void* reader) { return static_cast<int>(static_cast<Reader*>(reader)->rest_.empty()); }};
    }

private:
    int read(char* to, int size) {
        const std::size_t count = std::min(rest_.size(), static_cast<std::size_t>(size));
        if (count > 0) std::memcpy(to, rest_.data(), count);
        rest_ = rest_.subspan(count);
        if (count > 0) return static_cast<int>(count);
        overran_ = true;
        // After the end of an HDR, return line feeds: they end its header and fill its rows. With zeros, stb would
        // never stop unpacking.
        if (!is_hdr_) return 0;
        std::memset(to, '\n', static_cast<std::size_t>(size));
        return size;
    }
    void skip(int count) {
        const std::size_t forward = static_cast<std::size_t>(std::max(count, 0));
        overran_ = overran_ || forward > rest_.size();
        rest_ = rest_.subspan(std::min(rest_.size(), forward));
    }

    std::span<const std::byte> rest_;
    bool is_hdr_, overran_ = false;
};

// Calls one of stb's functions with the reader's callbacks.
template <class Function, class... Arguments>
auto call(Function function, Reader& reader, Arguments... arguments) {
    const stbi_io_callbacks callbacks = Reader::callbacks();
    return function(&callbacks, &reader, arguments...);
}

// Decodes the pixels with `load`, one of stb's functions, and stores them in the image.
// \throws FileError naming `name` if stb fails or the file ends too early
template <class T, class Load>
void read_values(Reader reader, StoredImage& image, const std::string& name, Load load) {
    int channels_in_file;
    const std::unique_ptr<T, decltype([](T* p) { stbi_image_free(p); })> values(
        call(load, reader, &image.width, &image.height, &channels_in_file, image.channels));
    if (!values) throw FileError(name, std::string("cannot be read: ") + stbi_failure_reason());
    if (reader.overran()) throw FileError(name, "is an image that breaks off before its end");
    const std::size_t count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                              static_cast<std::size_t>(image.channels);
    image.values = std::vector<T>(values.get(), values.get() + count);
}

}  // namespace

ImageInfo decode_info_stb(FileFormat format, std::span<const std::byte> bytes, const std::string& name) {
    Reader size_reader(format, bytes), depth_reader = size_reader;
    ImageInfo info;
    int channels = 0;
    if (!call(stbi_info_from_callbacks, size_reader, &info.width, &info.height, &channels))
        throw FileError(name, std::string("is not a readable image: ") + stbi_failure_reason());
    const char* type = format == FileFormat::hdr                           ? "float"
                       : call(stbi_is_16_bit_from_callbacks, depth_reader) ? "uint16"
                                                                           : "uint8";
    // A PNG without a palette may state one transparent colour in a tRNS chunk (PNG specification, 11.3.2.1). stb does
    // not count the alpha channel that results from it, but decodes it.
    const auto is_transparency = [](const PngChunk& chunk) { return chunk.type == "tRNS"; };
    if (format == FileFormat::png && channels % 2 == 1)
        channels += std::ranges::any_of(png_header_chunks(bytes), is_transparency) ? 1 : 0;
    constexpr const char* kNames[] = {"Y", "YA", "RGB", "RGBA"};
    for (const char* c = kNames[channels - 1]; *c != '\0'; ++c) info.channels.push_back({std::string(1, *c), type});
    return info;
}

StoredImage decode_stb(FileFormat format, std::span<const std::byte> bytes, const std::string& name, int most) {
    const ImageInfo info = decode_info_stb(format, bytes, name);
    const Reader reader(format, bytes);
    StoredImage image;
    image.channels = std::min(static_cast<int>(info.channels.size()), most);
    require_possible_size(info.width, info.height, image.channels, bytes.size(), name);
    if (format == FileFormat::png) read_png_transfer(bytes, image);
    const std::string& type = info.channels.front().type;
    if (type == "float") {
        image.transfer = Transfer::linear;
        read_values<float>(reader, image, name, stbi_loadf_from_callbacks);
    } else if (type == "uint16") {
        read_values<std::uint16_t>(reader, image, name, stbi_load_16_from_callbacks);
    } else {
        read_values<std::uint8_t>(reader, image, name, stbi_load_from_callbacks);
    }
    return image;
}

}  // namespace limn
