// Pictures through OpenImageIO. Writing goes to memory, since its writers report success on a full disk.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <new>
#include <string_view>

#include "io/image_codec.h"
#include "io/read_file.h"
#include "limn/core/error.h"

namespace limn {

namespace {

using OIIO::ImageInput;
using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

// x and y of red, green, blue and white (ITU-R BT.709-6, section 1).
constexpr float kBt709[8] = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};

ImageSpec spec_of(const EncodeJob& job) {
    if (job.format == FileFormat::png) {
        ImageSpec spec(job.width, job.height, 3, TypeDesc::UINT8);
        spec.attribute("oiio:ColorSpace", "sRGB");
        return spec;
    }
    ImageSpec spec(job.width, job.height, 3, job.half ? TypeDesc::HALF : TypeDesc::FLOAT);
    spec.attribute("oiio:ColorSpace", "Linear");
    spec.attribute("chromaticities", TypeDesc(TypeDesc::FLOAT, 8), kBt709);
    spec.attribute("compression", "zip");
    spec.attribute("DateTime", "");  // else the time of day is written, and no two files are alike
    return spec;
}

std::string message(std::string detail) {
    while (!detail.empty() && detail.back() == '\n') detail.pop_back();
    return detail.empty() ? "unknown reason" : detail;
}

// Picks the format of a file in memory. OpenImageIO looks for it on disk all the same, so it is one that cannot exist.
std::string name_in_memory(FileFormat format) {
    return format == FileFormat::png ? "/dev/null/memory.png" : "/dev/null/memory.exr";
}

// A JPEG that breaks off is read as if it were filled with grey, and such a PNG leaks memory; so the end is looked for.
void require_end(std::string_view file, const std::string& path) {
    bool whole = true;
    if (file.starts_with("\xff\xd8")) {
        // ITU-T T.81, table B.1: neither marker occurs within the data of a scan.
        const std::size_t scan = file.rfind("\xff\xda"), end = file.rfind("\xff\xd9");
        whole = end != std::string_view::npos && (scan == std::string_view::npos || scan < end);
    } else if (file.starts_with("\x89PNG")) {
        whole = file.find("IEND\xae\x42\x60\x82") != std::string_view::npos;
    }
    if (!whole) throw FileError(path, "is an image that breaks off before its end");
}

// Opens the file `name`, or its bytes in `memory`; `path` is for messages.
std::unique_ptr<ImageInput> open(const std::string& name, const std::string& path,
                                 OIIO::Filesystem::IOProxy* memory = nullptr) {
    ImageSpec wishes;
    wishes.attribute("oiio:UnassociatedAlpha", 1);  // colours as stored, not multiplied by alpha
    if (memory) wishes.attribute("oiio:ioproxy", TypeDesc::PTR, &memory);
    std::unique_ptr<ImageInput> input = ImageInput::open(name, &wishes);
    if (!input) throw FileError(path, "is not a readable image: " + message(OIIO::geterror()));
    return input;
}

std::unique_ptr<ImageInput> open_file(const std::string& path) {
    require_readable(path);
    char first = 0;
    std::ifstream(path, std::ios::binary).get(first);
    if (first == '\xff' || first == '\x89') require_end(read_file(path), path);
    return open(path, path);
}

// A header may promise any size. Deflate packs 1032 to 1 at best, so a small file of a large picture is broken; up to
// a gibibyte the reader finds out by itself.
void require_plausible(const ImageSpec& spec, std::uintmax_t file_bytes, const std::string& path) {
    if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1 || spec.nchannels <= 0 || spec.deep)
        throw FileError(path, "is not a flat picture with at least one pixel");
    constexpr double kHarmless = 1 << 30, kBestPacking = 5000;
    const double bytes = static_cast<double>(spec.width) * spec.height * spec.nchannels * 4.0;
    if (bytes > kHarmless && bytes > kBestPacking * static_cast<double>(file_bytes))
        throw FileError(
            path, "is too short for a picture of " + std::to_string(spec.width) + " x " + std::to_string(spec.height));
}

void read_transfer(const ImageSpec& spec, StoredImage& image) {
    const std::string space = spec.get_string_attribute("oiio:ColorSpace");
    const float gamma = spec.get_float_attribute("oiio:Gamma", 0);
    if (OIIO::Strutil::iequals(space, "linear")) {
        image.transfer = Transfer::linear;
    } else if (OIIO::Strutil::iequals(space, "srgb")) {
        image.transfer = Transfer::srgb;
    } else if (gamma > 0 && std::isfinite(gamma)) {
        image.transfer = Transfer::power;
        image.exponent = gamma;
    }
}

Facts read_facts(const ImageSpec& spec) {
    const std::size_t prefix = std::strlen(kFactPrefix);
    Facts facts;
    for (const auto& attribute : spec.extra_attribs) {
        const std::string name = attribute.name().string();
        if (name.compare(0, prefix, kFactPrefix) == 0 && attribute.type() == TypeDesc::STRING)
            facts.emplace_back(name.substr(prefix), attribute.get_string());
    }
    return facts;
}

template <class T>
void read_values(ImageInput& input, TypeDesc type, StoredImage& image, const std::string& path) {
    std::vector<T>& values = image.values.emplace<std::vector<T>>();
    try {
        values.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                      static_cast<std::size_t>(image.channels));
    } catch (const std::bad_alloc&) {
        throw FileError(path, "there is not enough memory for its pixels");
    }
    if (!input.read_image(0, 0, 0, image.channels, type, values.data()) || input.has_error())
        throw FileError(path, "cannot be read: " + message(input.geterror()));
}

StoredImage read(ImageInput& input, std::uintmax_t file_bytes, const std::string& path) {
    const ImageSpec spec = input.spec();
    require_plausible(spec, file_bytes, path);
    StoredImage image;
    image.width = spec.width;
    image.height = spec.height;
    image.channels = std::min(spec.nchannels, 3);
    read_transfer(spec, image);
    image.facts = read_facts(spec);
    if (spec.format == TypeDesc::UINT8) {
        read_values<std::uint8_t>(input, TypeDesc::UINT8, image, path);
    } else if (spec.format.is_floating_point()) {
        read_values<float>(input, TypeDesc::FLOAT, image, path);
    } else {
        read_values<std::uint16_t>(input, TypeDesc::UINT16, image, path);  // wider integers lose their lowest bits
    }
    return image;
}

}  // namespace

bool can_encode(FileFormat format) { return format == FileFormat::exr || format == FileFormat::png; }

std::vector<std::byte> encode(const EncodeJob& job, const std::string& path) {
    const std::unique_ptr<ImageOutput> output = ImageOutput::create(name_in_memory(job.format));
    if (!output) throw FileError(path, "cannot be written: " + message(OIIO::geterror()));
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    ImageSpec spec = spec_of(job);
    for (const auto& [fact, value] : job.facts) spec.attribute(kFactPrefix + fact, value);
    const TypeDesc type = job.format == FileFormat::png ? TypeDesc::UINT8 : TypeDesc::FLOAT;
    const auto data = [](const auto& values) { return static_cast<const void*>(values.data()); };
    bool done = output->set_ioproxy(&memory) && output->open(name_in_memory(job.format), spec);
    done = done && output->write_image(type, std::visit(data, job.values));
    done = output->close() && done;
    if (!done || output->has_error()) throw FileError(path, "cannot be written: " + message(output->geterror()));
    const auto* begin = reinterpret_cast<const std::byte*>(bytes.data());
    return {begin, begin + bytes.size()};
}

StoredImage decode(FileFormat format, std::span<const std::byte> bytes, const std::string& path) {
    OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
    return read(*open(name_in_memory(format), path, &memory), bytes.size(), path);
}

StoredImage decode_file(const std::string& path) {
    std::error_code unknown;
    return read(*open_file(path), std::filesystem::file_size(path, unknown), path);
}

ImageInfo decode_info(const std::string& path) {
    const ImageSpec spec = open_file(path)->spec();
    ImageInfo info{.width = spec.width, .height = spec.height, .channels = {}};
    for (int i = 0; i < spec.nchannels; ++i)
        info.channels.push_back({std::string(spec.channel_name(i)), spec.channelformat(i).c_str()});
    return info;
}

Facts decode_facts(const std::string& path) { return read_facts(open_file(path)->spec()); }

}  // namespace limn
