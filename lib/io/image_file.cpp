// Reading pictures: transfer functions.
#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <type_traits>

#include "core/read_file.h"
#include "io/decode_stb.h"
#include "io/image_checks.h"
#include "io/image_codec.h"
#include "limn/core/error.h"
#include "limn/io/image_io.h"

namespace limn {

namespace {

// Linear value of a stored one, which is normalised to [0, 1] for integers.
double decode_value(double stored, Transfer transfer, double exponent) {
    switch (transfer) {
        case Transfer::srgb: return srgb_decode(stored);
        case Transfer::power: return std::copysign(std::pow(std::abs(stored), exponent), stored);
        case Transfer::linear:
        case Transfer::unsaid: break;
    }
    return stored;
}

Transfer transfer_of(const StoredImage& stored, Encoding encoding) {
    if (encoding == Encoding::raw) return Transfer::linear;
    if (encoding == Encoding::srgb) return Transfer::srgb;
    if (stored.transfer != Transfer::unsaid) return stored.transfer;
    return std::holds_alternative<std::vector<float>>(stored.values) ? Transfer::linear : Transfer::srgb;
}

// `linear(v)` is the linear value of the stored value v. Fewer than three channels: the first as grey.
template <class T, class Linear>
Image to_image(const StoredImage& stored, const std::vector<T>& values, Linear linear) {
    Image image(stored.width, stored.height);
    const std::span<float> out = image.values();
    const std::size_t channels = static_cast<std::size_t>(stored.channels);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = linear(values[channels < 3 ? i / 3 * channels : i]);
    return image;
}

Image to_image(const StoredImage& stored, Encoding encoding, const std::string& name) try {
    const Transfer transfer = transfer_of(stored, encoding);
    const auto convert = [&]<class T>(const std::vector<T>& values) {
        const auto linear = [&](double v) { return static_cast<float>(decode_value(v, transfer, stored.exponent)); };
        if constexpr (std::is_same_v<T, float>) {
            if (transfer == Transfer::linear)
                return to_image(stored, values, [](float v) { return v; });  // bit for bit
            return to_image(stored, values, linear);
        } else {
            const double largest = std::numeric_limits<T>::max();
            std::vector<float> table(std::size_t{1} << std::numeric_limits<T>::digits);
            for (std::size_t i = 0; i < table.size(); ++i) table[i] = linear(static_cast<double>(i) / largest);
            return to_image(stored, values, [&table](T v) { return table[v]; });
        }
    };
    return std::visit(convert, stored.values);
} catch (const ArgumentError&) {  // of Image, which has a size
    throw FileError(name, "there is not enough memory for its pixels");
}

// Hands a file's format and bytes to one of the codec's functions.
template <class Decode>
auto from_file(const std::string& path, Decode decode) {
    const std::string file = read_file(path);
    const std::span<const std::byte> bytes = std::as_bytes(std::span(file));
    return decode(require_sound(bytes, path), bytes, path);
}

// Running out of memory is a fault that concerns the file.
template <class Call>
auto with_memory(const std::string& path, Call call) try {
    return call();
} catch (const std::bad_alloc&) {
    throw FileError(path, "there is not enough memory for its pixels");
}

}  // namespace

Image load_image(const std::string& path, Encoding encoding) {
    const auto decode_pixels = [](const auto&... file) { return decode(file...); };
    return with_memory(path, [&] { return to_image(from_file(path, decode_pixels), encoding, path); });
}

Image load_image_from_memory(std::span<const std::byte> bytes, Encoding encoding, const std::string& name) {
    const FileFormat format = require_sound(bytes, name);
    if (format == FileFormat::exr)
        throw FileError(name, "is not a readable image: it is an EXR, which is read from a file alone, by OpenImageIO");
    return with_memory(name, [&] { return to_image(decode_stb(format, bytes, name), encoding, name); });
}

ImageInfo load_image_info(const std::string& path) { return from_file(path, decode_header).info; }

Facts load_image_facts(const std::string& path) { return from_file(path, decode_header).facts; }

}  // namespace limn
