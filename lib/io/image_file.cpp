// Implements the functions that read pictures: checks the file, decodes it and undoes its transfer function.
#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <type_traits>

#include "io/image_checks.h"
#include "io/image_codec.h"
#include "limn/io/image_io.h"
#include "limn/math/error.h"
#include "math/elementary.h"
#include "math/system/read_file.h"

namespace limn {

namespace {

// Returns the linear value of a stored one. An integer is given as a fraction of the largest one, in [0, 1].
double decode_value(double stored, Transfer transfer, double exponent) {
    switch (transfer) {
        case Transfer::srgb: return srgb_decode(stored);
        case Transfer::power: return std::copysign(power(std::abs(stored), exponent), stored);
        case Transfer::linear:
        case Transfer::unsaid: break;
    }
    return stored;
}

// Returns the transfer function that is to be undone. If neither `encoding` nor the file determines one, integers are
// sRGB and floats are linear.
Transfer transfer_of(const StoredImage& stored, Encoding encoding) {
    if (encoding == Encoding::raw) return Transfer::linear;
    if (encoding == Encoding::srgb) return Transfer::srgb;
    if (stored.transfer != Transfer::unsaid) return stored.transfer;
    return std::holds_alternative<std::vector<float>>(stored.values) ? Transfer::linear : Transfer::srgb;
}

// Returns one channel, as stored, in red, green and blue. Integers become fractions of the largest one.
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

// Returns the picture with linear values. linear(v) converts the stored value v. If there are fewer than three
// channels, the first one becomes red, green and blue.
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
                return to_image(stored, values, [](float v) { return v; });  // keeps every bit
            return to_image(stored, values, linear);
        } else {
            // Look up integers in a table of all values.
            const double largest = std::numeric_limits<T>::max();
            std::vector<float> table(std::size_t{1} << std::numeric_limits<T>::digits);
            for (std::size_t i = 0; i < table.size(); ++i) table[i] = linear(static_cast<double>(i) / largest);
            return to_image(stored, values, [&table](T v) { return table[v]; });
        }
    };
    return std::visit(convert, stored.values);
}

// Calls `call` and reports running out of memory as a FileError. An ArgumentError has the same cause here: an Image
// throws it if its size is too large.
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

// Reads a file and returns load(bytes, path).
template <class Load>
auto from_file(const std::string& path, Load load) {
    const std::string file = read_file(path);
    return load(std::as_bytes(std::span(file)), path);
}

}  // namespace

Image load_image_from_memory(std::span<const std::byte> bytes, Encoding encoding, const std::string& name) {
    const FileFormat format = require_sound(bytes, name);
    return with_memory(name, [&] { return to_image(decode(format, bytes, name), encoding); });
}

std::optional<Image> load_alpha_from_memory(std::span<const std::byte> bytes, const std::string& name) {
    const FileFormat format = require_sound(bytes, name);
    const std::vector<ImageChannel> channels = decode_header(format, bytes, name).channels;
    const auto alpha = std::ranges::find(channels, "A", &ImageChannel::name);
    if (alpha == channels.end()) return std::nullopt;
    const std::ptrdiff_t channel = alpha - channels.begin();
    return with_memory(name, [&] {
        const StoredImage stored = decode(format, bytes, name, static_cast<int>(channel) + 1);
        const auto to_grey = [&](const auto& v) { return grey_image(stored, v, static_cast<std::size_t>(channel)); };
        return std::visit(to_grey, stored.values);
    });
}

ImageInfo load_image_info_from_memory(std::span<const std::byte> bytes, const std::string& name) {
    return decode_header(require_sound(bytes, name), bytes, name);
}

Image load_image(const std::string& path, Encoding encoding) {
    return from_file(
        path, [&](const auto& bytes, const auto& name) { return load_image_from_memory(bytes, encoding, name); });
}

std::optional<Image> load_alpha(const std::string& path) { return from_file(path, load_alpha_from_memory); }

ImageInfo load_image_info(const std::string& path) { return from_file(path, load_image_info_from_memory); }

Facts load_image_facts(const std::string& path) { return load_image_info(path).facts; }

}  // namespace limn
