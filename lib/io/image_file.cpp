// Reading pictures: transfer functions.
#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <type_traits>

#include "core/elementary.h"
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
        case Transfer::power: return std::copysign(power(std::abs(stored), exponent), stored);
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

// One channel as grey, as stored.
template <class T>
Image grey_image(const StoredImage& stored, const std::vector<T>& values, std::size_t channel) {
    constexpr double kLargest = std::is_same_v<T, float> ? 1 : static_cast<double>(std::numeric_limits<T>::max());
    Image image(stored.width, stored.height);
    const std::span<float> out = image.values();
    const std::size_t channels = static_cast<std::size_t>(stored.channels);
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = static_cast<float>(values[i / 3 * channels + channel] / kLargest);
    return image;
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

Image to_image(const StoredImage& stored, Encoding encoding) {
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
}

// The alpha that is among the channels of a picture. `decode` gives the first so many of them.
template <class Decode>
std::optional<Image> to_alpha(const ImageInfo& info, const Decode& decode) {
    const auto alpha = std::ranges::find(info.channels, "A", &ImageChannel::name);
    if (alpha == info.channels.end()) return std::nullopt;
    const std::ptrdiff_t channel = alpha - info.channels.begin();
    const StoredImage stored = decode(static_cast<int>(channel) + 1);
    return std::visit([&](const auto& values) { return grey_image(stored, values, static_cast<std::size_t>(channel)); },
                      stored.values);
}

// Hands a file's format and bytes to one of the codec's functions.
template <class Decode>
auto from_file(const std::string& path, Decode decode) {
    const std::string file = read_file(path);
    const std::span<const std::byte> bytes = std::as_bytes(std::span(file));
    return decode(require_sound(bytes, path), bytes, path);
}

// Running out of memory is a fault that concerns the file; of an Image, which has a size, so is an ArgumentError.
template <class Call>
auto with_memory(const std::string& path, Call call) {
    constexpr const char* kProblem = "there is not enough memory for its pixels";
    try {
        return call();
    } catch (const std::bad_alloc&) {
        throw FileError(path, kProblem);
    } catch (const ArgumentError&) {
        throw FileError(path, kProblem);
    }
}

FileFormat require_readable_in_memory(std::span<const std::byte> bytes, const std::string& name) {
    const FileFormat format = require_sound(bytes, name);
    if (format == FileFormat::exr)
        throw FileError(name, "is not a readable image: it is an EXR, which is read from a file alone, by OpenImageIO");
    return format;
}

}  // namespace

Image load_image(const std::string& path, Encoding encoding) {
    const auto decode_pixels = [](const auto&... file) { return decode(file...); };
    return with_memory(path, [&] { return to_image(from_file(path, decode_pixels), encoding); });
}

Image load_image_from_memory(std::span<const std::byte> bytes, Encoding encoding, const std::string& name) {
    const FileFormat format = require_readable_in_memory(bytes, name);
    return with_memory(name, [&] { return to_image(decode_stb(format, bytes, name), encoding); });
}

std::optional<Image> load_alpha(const std::string& path) {
    const auto decode_alpha = [](const auto&... file) {
        return to_alpha(decode_header(file...).info, [&](int most) { return decode(file..., most); });
    };
    return with_memory(path, [&] { return from_file(path, decode_alpha); });
}

std::optional<Image> load_alpha_from_memory(std::span<const std::byte> bytes, const std::string& name) {
    const FileFormat format = require_readable_in_memory(bytes, name);
    return with_memory(name, [&] {
        return to_alpha(decode_info_stb(format, bytes, name),
                        [&](int most) { return decode_stb(format, bytes, name, most); });
    });
}

ImageInfo load_image_info(const std::string& path) { return from_file(path, decode_header).info; }

Facts load_image_facts(const std::string& path) { return from_file(path, decode_header).facts; }

}  // namespace limn
