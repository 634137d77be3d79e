// Implements the functions that write pictures: checks the arguments, encodes the picture, decodes it again to verify
// it, and replaces the file.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <new>
#include <numeric>

#include "io/image_codec.h"
#include "io/text_lines.h"
#include "limn/image/encode.h"
#include "limn/io/image_io.h"
#include "limn/math/error.h"
#include "math/system/replace_file.h"

namespace limn {

namespace {

constexpr float kLargestHalf = 65504;      // (2 - 2^-10) 2^15 (IEEE 754 binary16)
constexpr float kLargestRgbe = 0xFFp119f;  // 255 2^(127 - 8) (Ward, Real Pixels, Graphics Gems II, 1991)

// Returns the format for the suffix of a file. \throws FileError if it cannot be written
FileFormat format_of(const std::string& path) {
    const std::string suffix = in_lower_case(std::filesystem::path(path).extension().string());
    std::string known;
    for (const PictureFormat& row : kPictureFormats) {
        if (row.suffix == nullptr || !can_encode(*row.format)) continue;
        if (suffix == row.suffix) return *row.format;
        known += (known.empty() ? "" : " or ") + std::string(row.suffix);
    }
    const char* hint = suffix == ".exr" ? "this build has no OpenImageIO and cannot write EXR; " : "";
    throw FileError(path, hint + ("the name of a picture must end in " + known));
}

// Returns true if the text can be the name of a fact or a channel. The limit of 70 characters is for PNG: a keyword,
// kFactPrefix included, has at most 79 (PNG specification, 11.3.4.2).
bool is_name(const std::string& text) {
    return !text.empty() && text.size() <= 70 &&
           std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c <= '~'; });
}

void check_facts(const Facts& facts) {
    for (const auto& [name, value] : facts) {
        if (!is_name(name))
            throw ArgumentError("save_image: the name of a fact must be 1 to 70 printable characters: '" + name + "'");
        if (value.find('\0') != std::string::npos)
            throw ArgumentError("save_image: the fact " + name + " has a zero byte");
    }
}

void check_layers(const SaveOptions& options, const Image& image) {
    const auto has_one_each = [&](const std::vector<float>& values) {
        return 3 * values.size() == image.values().size();
    };
    if (!options.alpha.empty() && !has_one_each(options.alpha))
        throw ArgumentError("save_image: alpha does not have one value for each pixel");
    std::vector<std::string> taken = {"R", "G", "B", "A"};
    for (const ImageLayer& layer : options.layers) {
        if (!is_name(layer.name) || std::find(taken.begin(), taken.end(), layer.name) != taken.end())
            throw ArgumentError("save_image: no channel can be called '" + layer.name + "'");
        if (!has_one_each(layer.values))
            throw ArgumentError("save_image: the channel " + layer.name + " does not have one value for each pixel");
        taken.push_back(layer.name);
    }
}

void check_part(const std::optional<PartOf>& part, const Image& image) {
    if (!part) return;
    const auto fits = [](int first, int size, int whole) { return first >= 0 && first <= whole - size; };
    if (!fits(part->left, image.width(), part->width) || !fits(part->top, image.height(), part->height))
        throw ArgumentError("save_image: the picture is not inside the whole that SaveOptions::part_of states");
}

// Throws a FileError if the picture is empty or if the format cannot store one of its values.
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
        refuse([](float v) { return !std::isfinite(v); }, "not finite; only an EXR can store it");
    if (format == FileFormat::hdr) refuse([](float v) { return v > kLargestRgbe; }, "too large for HDR");
    if (format == FileFormat::exr && half)
        refuse([](float v) { return std::abs(v) > kLargestHalf && !std::isinf(v); }, "too large for half (65504)");
}

// Returns the nearest half, ties to even. A half has 11 significant bits, and its last bit is at least 2^-24. \pre the
// value is not finite, or within the range of half
float round_to_half(float v) {
    if (v == 0 || !std::isfinite(v)) return v;
    const int last_bit = std::max(std::ilogb(v) - 10, -24);
    return std::ldexp(std::nearbyint(std::ldexp(v, -last_bit)), last_bit);
}

// Rounds a colour to the nearest one that an HDR stores: no component is negative, and all have the 8 bits of the
// largest one. A colour that stb takes for black becomes black.
void round_to_rgbe(std::span<float, 3> rgb) {
    const float largest = std::max({rgb[0], rgb[1], rgb[2]});
    int last_bit = largest < 1e-32f ? 0 : std::ilogb(largest) - 7;
    if (std::nearbyint(std::ldexp(largest, -last_bit)) == 256) ++last_bit;
    for (float& v : rgb)
        v = largest < 1e-32f || v <= 0 ? 0 : std::ldexp(std::nearbyint(std::ldexp(v, -last_bit)), last_bit);
}

// Returns the values of a file of floats, rounded to the precision of the format. Each pixel has the colour, alpha if
// there is one, and a value of each layer.
std::vector<float> interleaved(const Image& image, const SaveOptions& options, FileFormat format) {
    const bool is_exr = format == FileFormat::exr, is_half = is_exr && options.half;
    const std::size_t layers = is_exr ? options.layers.size() : 0, alpha = is_exr && !options.alpha.empty() ? 1 : 0;
    const std::span<const float> colours = image.values();
    std::vector<float> values;
    values.reserve(colours.size() / 3 * (3 + alpha + layers));
    for (std::size_t i = 0; i < colours.size() / 3; ++i) {
        const std::size_t first = values.size();
        values.insert(values.end(), &colours[3 * i], &colours[3 * i] + 3);
        if (alpha > 0) values.push_back(options.alpha[i]);
        if (format == FileFormat::hdr) round_to_rgbe(std::span<float, 3>(&values[first], 3));
        if (is_half) std::transform(&values[first], &values[first] + 3 + alpha, &values[first], round_to_half);
        for (std::size_t k = 0; k < layers; ++k) values.push_back(options.layers[k].values[i]);
    }
    return values;
}

// Return true if the values have the same bits. Any two NaNs are equal, because half shortens the payload of a NaN.
bool same_value(std::uint8_t a, std::uint8_t b) { return a == b; }
bool same_value(float a, float b) {
    return (a == b && std::signbit(a) == std::signbit(b)) || (std::isnan(a) && std::isnan(b));
}

// Returns, for each channel of the file, the index of the same channel in the job. Readers may change the order of
// layers. Returns an empty vector if the file has a channel that the job does not have.
std::vector<std::size_t> order_of(const std::vector<ImageChannel>& channels, const EncodeJob& job) {
    const auto first_layer = static_cast<std::size_t>(job.colours());
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const auto found = std::ranges::find(job.layers, channels[i].name);
        order.push_back(i < first_layer ? i : first_layer + static_cast<std::size_t>(found - job.layers.begin()));
        if (order.back() >= static_cast<std::size_t>(job.channels())) return {};
    }
    return order;
}

// Returns true if a picture file holds exactly the values of the job.
bool holds(const std::vector<std::byte>& bytes, const EncodeJob& job, const std::string& path) {
    // Decode it, and compare the size.
    const StoredImage stored = decode(job.format, bytes, path, job.channels());
    if (stored.width != job.width || stored.height != job.height || stored.channels != job.channels()) return false;
    // Find the order of its channels.
    std::vector<std::size_t> order(static_cast<std::size_t>(job.channels()));
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (!job.layers.empty()) order = order_of(decode_header(job.format, bytes, path).channels, job);
    // Compare the values.
    const auto equal = [&](const auto& values) {
        using Value = typename std::remove_cvref_t<decltype(values)>::value_type;
        const auto* back = std::get_if<std::vector<Value>>(&stored.values);
        if (!back || back->size() != values.size() || order.empty()) return false;
        for (std::size_t pixel = 0; pixel < values.size(); pixel += order.size())
            for (std::size_t c = 0; c < order.size(); ++c)
                if (!same_value((*back)[pixel + c], values[pixel + order[c]])) return false;
        return true;
    };
    return std::visit(equal, job.values);
}

// Returns the job for a picture, without its values.
EncodeJob job_of(const Image& image, FileFormat format, const SaveOptions& options) {
    EncodeJob job{format, image.width(), image.height(), {}, options.half, options.facts};
    job.has_alpha = !options.alpha.empty() && format != FileFormat::hdr;
    if (format != FileFormat::exr) return job;
    for (const ImageLayer& layer : options.layers) job.layers.push_back(layer.name);
    job.part_of = options.part_of;
    return job;
}

void save(const Image& image, const std::string& path, const SaveOptions& options) {
    // Check the arguments.
    const FileFormat format = format_of(path);
    check_facts(options.facts);
    check_layers(options, image);
    check_part(options.part_of, image);
    check_values(image, path, format, options.half);
    // Convert the values to those that the file stores.
    const bool is_png = format == FileFormat::png;
    std::vector<std::uint8_t> bytes_of_png;
    std::vector<float> floats;
    EncodeJob job = job_of(image, format, options);
    if (is_png)
        job.values = std::span<const std::uint8_t>(bytes_of_png = encode_srgb8(image, options.exposure, options.alpha));
    else if (format == FileFormat::exr && !options.half && job.channels() == 3)
        job.values = image.values();
    else
        job.values = std::span<const float>(floats = interleaved(image, options, format));
    // Encode the picture, verify it, and write the file.
    const std::vector<std::byte> bytes = encode(job, path);
    if (!holds(bytes, job, path)) throw FileError(path, "the values that were read back differ from those written");
    replace_file(path, bytes);
}

// Calls `call` and reports running out of memory as a FileError.
template <class Call>
void with_memory(const std::string& path, Call call) try {
    call();
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

}  // namespace limn
