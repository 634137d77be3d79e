// The only source that holds stb_image; its functions stay in here.
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_BMP
#define STBI_ONLY_HDR
#define STBI_ONLY_JPEG
#define STBI_ONLY_PNG
#define STBI_ONLY_TGA
#include <stb_image.h>

#include <cstring>
#include <limits>
#include <memory>
#include <string_view>
#include <type_traits>

#include "io/decode_stb.h"
#include "io/png_chunks.h"
#include "limn/core/error.h"

namespace limn {

namespace {

void read_png_header(std::span<const std::byte> bytes, StoredImage& image) {
    const std::size_t prefix = std::strlen(kFactPrefix);
    for (const auto& [type, data] : png_header_chunks(bytes)) {
        if (type == "sRGB") {
            image.transfer = Transfer::srgb;
        } else if (type == "gAMA" && data.size() == 4 && image.transfer == Transfer::unsaid) {
            double gamma = 0;  // of encoding, times 100000 (PNG specification, 11.3.3.2)
            for (const char c : data) gamma = 256 * gamma + static_cast<unsigned char>(c);
            if (gamma == 0) continue;
            image.transfer = Transfer::power;
            image.exponent = 100000 / gamma;
        } else if (type == "tEXt" && data.compare(0, prefix, kFactPrefix) == 0) {
            const std::size_t end = data.find('\0');
            if (end != std::string::npos)
                image.facts.emplace_back(data.substr(prefix, end - prefix), data.substr(end + 1));
        }
    }
}

template <class T, class Load>
void read_values(std::span<const std::byte> bytes, StoredImage& image, const std::string& name, Load load) {
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    int channels_in_file;
    const std::unique_ptr<T, decltype([](T* p) { stbi_image_free(p); })> values(load(
        data, static_cast<int>(bytes.size()), &image.width, &image.height, &channels_in_file, image.channels));
    if (!values) throw FileError(name, std::string("cannot be read: ") + stbi_failure_reason());
    const std::size_t count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                              static_cast<std::size_t>(image.channels);
    image.values = std::vector<T>(values.get(), values.get() + count);
}

}  // namespace

void require_whole_jpeg(std::span<const std::byte> bytes, const std::string& name) {
    const std::string_view file(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (!file.starts_with("\xff\xd8")) return;
    // ITU-T T.81, table B.1: within the data of a scan, neither marker occurs.
    const std::size_t scan = file.rfind("\xff\xda"), end = file.rfind("\xff\xd9");
    if (end == std::string_view::npos || (scan != std::string_view::npos && end < scan))
        throw FileError(name, "is a JPEG that breaks off before its end");
}

StoredImage decode_stb(std::span<const std::byte> bytes, const std::string& name) {
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw FileError(name, "is larger than 2 GiB");
    require_whole_jpeg(bytes, name);
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    StoredImage image;
    int channels_in_file;
    if (!stbi_info_from_memory(data, size, &image.width, &image.height, &channels_in_file))
        throw FileError(name, std::string("is not a readable image: ") + stbi_failure_reason());
    image.channels = channels_in_file < 3 ? 1 : 3;  // alpha is left out
    read_png_header(bytes, image);
    if (stbi_is_hdr_from_memory(data, size)) {
        image.transfer = Transfer::linear;
        read_values<float>(bytes, image, name, stbi_loadf_from_memory);
    } else if (stbi_is_16_bit_from_memory(data, size)) {
        read_values<std::uint16_t>(bytes, image, name, stbi_load_16_from_memory);
    } else {
        read_values<std::uint8_t>(bytes, image, name, stbi_load_from_memory);
    }
    return image;
}

}  // namespace limn
