// The shared part of reading and writing pictures: suffixes, transfer functions, verification.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <new>
#include <type_traits>

#include "core/read_file.h"
#include "core/replace_file.h"
#include "io/decode_stb.h"
#include "io/image_checks.h"
#include "io/image_codec.h"
#include "limn/core/error.h"
#include "limn/io/image_io.h"

namespace limn {

namespace {

constexpr float kLargestHalf = 65504;      // (2 - 2^-10) 2^15 (IEEE 754 binary16)
constexpr float kLargestRgbe = 0xFFp119f;  // 255 2^(127 - 8) (Ward, Real Pixels, Graphics Gems II, 1991)

constexpr std::pair<const char*, FileFormat> kSuffixes[] = {
    {".exr", FileFormat::exr}, {".png", FileFormat::png}, {".hdr", FileFormat::hdr}};

FileFormat format_of(const std::string& path) {
    std::string suffix = std::filesystem::path(path).extension().string();
    for (char& c : suffix)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    std::string known;
    for (const auto& [name, format] : kSuffixes) {
        if (!can_encode(format)) continue;
        if (suffix == name) return format;
        known += (known.empty() ? "" : " or ") + std::string(name);
    }
    const char* hint = suffix == ".exr" ? "this build has no OpenImageIO and cannot write EXR; " : "";
    throw FileError(path, hint + ("the name of a picture must end in " + known));
}

// With its prefix, a PNG keyword has at most 79 characters (PNG specification, 11.3.4.2).
bool is_name(const std::string& text) {
    return !text.empty() && text.size() <= 70 &&
           std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c <= '~'; });
}

void check_facts(const Facts& facts) {
    for (const auto& [name, value] : facts) {
        if (!is_name(name))
            throw ArgumentError("save_image: the name of a fact must be 1 to 70 printable characters: '" + name + "'");
        if (value.find('\0') != std::string::npos)
            throw ArgumentError("save_image: the fact " + name + " holds a zero byte");
    }
}

void check_layers(const std::vector<ImageLayer>& layers, const Image& image) {
    std::vector<std::string> taken = {"R", "G", "B", "A"};
    for (const ImageLayer& layer : layers) {
        if (!is_name(layer.name) || std::find(taken.begin(), taken.end(), layer.name) != taken.end())
            throw ArgumentError("save_image: no channel can be called '" + layer.name + "'");
        if (3 * layer.values.size() != image.values().size())
            throw ArgumentError("save_image: the channel " + layer.name + " has not one value a pixel");
        taken.push_back(layer.name);
    }
}

void check_values(const Image& image, const std::string& path, FileFormat format, bool half) {
    if (image.empty()) throw FileError(path, "the image has no pixels");
    const auto refuse = [&](auto bad, const std::string& why) {
        const std::span<const float> values = image.values();
        const auto found = std::find_if(values.begin(), values.end(), bad);
        if (found == values.end()) return;
        const std::ptrdiff_t pixel = (found - values.begin()) / 3;
        throw FileError(path, "pixel (" + std::to_string(pixel % image.width()) + ", " +
                                  std::to_string(pixel / image.width()) + ") is " + why);
    };
    if (format != FileFormat::exr)
        refuse([](float v) { return !std::isfinite(v); }, "not finite, which only EXR holds");
    if (format == FileFormat::hdr) refuse([](float v) { return v > kLargestRgbe; }, "too large for HDR");
    if (format == FileFormat::exr && half)
        refuse([](float v) { return std::abs(v) > kLargestHalf && !std::isinf(v); }, "too large for half (65504)");
}

// Round half up, as other writers do.
std::vector<std::uint8_t> to_srgb8(std::span<const float> values) {
    std::vector<std::uint8_t> encoded(values.size());
    std::transform(values.begin(), values.end(), encoded.begin(), [](float v) {
        return static_cast<std::uint8_t>(std::floor(255 * srgb_encode(std::clamp(v, 0.0f, 1.0f)) + 0.5));
    });
    return encoded;
}

// The nearest half, ties to even, of a value that has one: 11 significant bits, the last at least 2^-24.
float round_to_half(float v) {
    if (v == 0 || !std::isfinite(v)) return v;
    const int last_bit = std::max(std::ilogb(v) - 10, -24);
    return std::ldexp(std::nearbyint(std::ldexp(v, -last_bit)), last_bit);
}

// The nearest colour whose components have 8 bits below the largest one's exponent; none are negative. Those that stb
// takes for black are.
void round_to_rgbe(std::span<float, 3> rgb) {
    const float largest = std::max({rgb[0], rgb[1], rgb[2]});
    int last_bit = largest < 1e-32f ? 0 : std::ilogb(largest) - 7;
    if (std::nearbyint(std::ldexp(largest, -last_bit)) == 256) ++last_bit;
    for (float& v : rgb)
        v = largest < 1e-32f || v <= 0 ? 0 : std::ldexp(std::nearbyint(std::ldexp(v, -last_bit)), last_bit);
}

// The values that the file will hold; `storage` keeps those that are not the image's own.
std::span<const float> to_storable(const Image& image, FileFormat format, bool half, std::vector<float>& storage) {
    if (format == FileFormat::exr && !half) return image.values();
    storage.assign(image.values().begin(), image.values().end());
    if (format == FileFormat::exr)
        for (float& v : storage) v = round_to_half(v);
    else
        for (std::size_t i = 0; i < storage.size(); i += 3) round_to_rgbe(std::span<float, 3>(&storage[i], 3));
    return storage;
}

// Pixel by pixel the colour's three values and one of each layer.
std::vector<float> interleaved(std::span<const float> colours, const std::vector<ImageLayer>& layers) {
    std::vector<float> values;
    values.reserve(colours.size() / 3 * (3 + layers.size()));
    for (std::size_t i = 0; i < colours.size() / 3; ++i) {
        values.insert(values.end(), &colours[3 * i], &colours[3 * i] + 3);
        for (const ImageLayer& layer : layers) values.push_back(layer.values[i]);
    }
    return values;
}

bool same_value(std::uint8_t a, std::uint8_t b) { return a == b; }
// Bit for bit but for the payload of a NaN, which half cuts.
bool same_value(float a, float b) {
    return (a == b && std::signbit(a) == std::signbit(b)) || (std::isnan(a) && std::isnan(b));
}

// The file holds just the values that were to be written.
bool holds(const StoredImage& stored, const EncodeJob& job) {
    if (stored.width != job.width || stored.height != job.height) return false;
    if (stored.channels != 3 + static_cast<int>(job.layers.size())) return false;
    const auto equal = [&stored](const auto& values) {
        using Value = typename std::remove_cvref_t<decltype(values)>::value_type;
        const auto* back = std::get_if<std::vector<Value>>(&stored.values);
        return back && std::equal(values.begin(), values.end(), back->begin(), back->end(),
                                  [](Value a, Value b) { return same_value(a, b); });
    };
    return std::visit(equal, job.values);
}

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

void save(const Image& image, const std::string& path, const SaveOptions& options) {
    const FileFormat format = format_of(path);
    check_facts(options.facts);
    check_layers(options.layers, image);
    check_values(image, path, format, options.half);
    std::vector<std::uint8_t> srgb;
    std::vector<float> rounded;
    EncodeJob job{format, image.width(), image.height(), {}, options.half, options.facts};
    if (format == FileFormat::png)
        job.values = std::span<const std::uint8_t>(srgb = to_srgb8(image.values()));
    else
        job.values = to_storable(image, format, options.half, rounded);
    if (format == FileFormat::exr && !options.layers.empty()) {
        std::vector<ImageLayer> layers = options.layers;
        std::sort(layers.begin(), layers.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
        for (const ImageLayer& layer : layers) job.layers.push_back(layer.name);  // in the order of an EXR
        rounded = interleaved(std::get<std::span<const float>>(job.values), layers);
        job.values = std::span<const float>(rounded);
    }
    const std::vector<std::byte> bytes = encode(job, path);
    if (!holds(decode(format, bytes, path, 3 + static_cast<int>(job.layers.size())), job))
        throw FileError(path, "what was written does not read back");
    replace_file(path, bytes);
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

void save_image(const Image& image, const std::string& path, const SaveOptions& options) {
    with_memory(path, [&] { save(image, path, options); });
}

void check_image_name(const std::string& path) { format_of(path); }

bool image_holds_layers(const std::string& path) { return format_of(path) == FileFormat::exr; }

void check_writable(const std::string& path) {
    format_of(path);
    check_replaceable(path);
}

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
