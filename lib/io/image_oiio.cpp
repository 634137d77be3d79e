// Implements the image codec with OpenImageIO. Pictures are written to memory, because OpenImageIO's writers report
// success on a full disk.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>

#include "io/decode_stb.h"
#include "io/image_checks.h"
#include "io/image_codec.h"
#include "limn/math/error.h"

namespace limn {

namespace {

using OIIO::ImageInput;
using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

// The chromaticities x and y of red, green, blue and white (ITU-R BT.709-6, section 1).
constexpr float kBt709[8] = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};

// Returns OpenImageIO's description of the file to write.
ImageSpec spec_of(const EncodeJob& job) {
    // Describe a PNG.
    if (job.format == FileFormat::png) {
        ImageSpec spec(job.width, job.height, job.colours(), TypeDesc::UINT8);
        spec.attribute("oiio:UnassociatedAlpha", 1);
        spec.attribute("oiio:ColorSpace", "sRGB");
        return spec;
    }
    // Describe the channels of an EXR. Layers are float even if colours are half.
    ImageSpec spec(job.width, job.height, job.channels(), job.half ? TypeDesc::HALF : TypeDesc::FLOAT);
    spec.channelnames = {"R", "G", "B"};
    if (job.has_alpha) spec.channelnames.emplace_back("A");
    spec.alpha_channel = job.has_alpha ? 3 : -1;
    spec.channelnames.insert(spec.channelnames.end(), job.layers.begin(), job.layers.end());
    if (job.half && !job.layers.empty()) {
        spec.channelformats.assign(static_cast<std::size_t>(job.colours()), TypeDesc::HALF);
        spec.channelformats.resize(spec.channelnames.size(), TypeDesc::FLOAT);
    }
    // Set the data window and the display window.
    if (const auto& whole = job.part_of) {
        spec.x = whole->left;
        spec.y = whole->top;
        spec.full_width = whole->width;
        spec.full_height = whole->height;
    }
    // Set the other attributes. An empty DateTime keeps the time of writing out of the file, so that the same picture
    // gives the same bytes.
    spec.attribute("oiio:ColorSpace", "Linear");
    spec.attribute("chromaticities", TypeDesc(TypeDesc::FLOAT, 8), kBt709);
    spec.attribute("compression", "zip");
    spec.attribute("DateTime", "");
    return spec;
}

// Returns an error message of OpenImageIO without line feeds at its end.
std::string message(std::string detail) {
    while (!detail.empty() && detail.back() == '\n') detail.pop_back();
    return detail.empty() ? "unknown reason" : detail;
}

// Returns the name of a picture in memory. OpenImageIO looks for a file of this name even when it reads memory, so the
// name is one that cannot exist.
std::string name_in_memory(FileFormat format) { return std::string("/dev/null/memory.") + row_of(format).openimageio; }

// A reader of memory that never reads beyond the end of the bytes. The one of OpenImageIO 2.4 does if a file states an
// offset that is too large.
class BoundedReader : public OIIO::Filesystem::IOMemReader {
public:
    explicit BoundedReader(std::span<const std::byte> bytes) : IOMemReader(bytes.data(), bytes.size()) {}
    std::size_t pread(void* to, std::size_t size, std::int64_t offset) override {
        const bool is_inside = offset >= 0 && static_cast<std::uint64_t>(offset) < this->size();
        return is_inside ? IOMemReader::pread(to, size, offset) : 0;
    }
};

// Opens a picture with the reader of its format. OpenImageIO is not asked to choose one, because it would try the
// readers of all formats on a broken file. \throws FileError naming `path`
std::unique_ptr<ImageInput> open(FileFormat format, OIIO::Filesystem::IOProxy& memory, const std::string& path) {
    ImageSpec spec, wishes;
    wishes.attribute("oiio:UnassociatedAlpha", 1);  // colours as stored, not multiplied by alpha
    std::unique_ptr<ImageInput> input = ImageInput::create(row_of(format).openimageio);
    if (!input) throw FileError(path, "is not a readable image: " + message(OIIO::geterror()));
    if (!input->set_ioproxy(&memory) || !input->open(name_in_memory(format), spec, wishes))
        throw FileError(path, "is not a readable image: " + message(input->geterror()));
    return input;
}

// Sets the transfer function that a file states.
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

// Returns the facts that save_image has written.
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

// Decodes the pixels as values of type T, which is `type` of OpenImageIO. \throws FileError naming `path`
template <class T>
void read_values(ImageInput& input, TypeDesc type, StoredImage& image, const std::string& path) {
    std::vector<T>& values = image.values.emplace<std::vector<T>>();
    values.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                  static_cast<std::size_t>(image.channels));
    if (!input.read_image(0, 0, 0, image.channels, type, values.data()) || input.has_error())
        throw FileError(path, "cannot be read: " + message(input.geterror()));
}

// Decodes a picture. `file_bytes` is the size of its file. \throws FileError naming `path`
StoredImage read(ImageInput& input, std::size_t file_bytes, const std::string& path, int most = 3) {
    const ImageSpec spec = input.spec();
    if (spec.depth > 1 || spec.deep) throw FileError(path, "is not a flat picture");
    require_possible_size(spec.width, spec.height, spec.nchannels, file_bytes, path);
    StoredImage image;
    image.width = spec.width;
    image.height = spec.height;
    image.channels = std::min(spec.nchannels, most);
    read_transfer(spec, image);
    if (spec.format == TypeDesc::UINT8) {
        read_values<std::uint8_t>(input, TypeDesc::UINT8, image, path);
    } else if (spec.format.is_floating_point()) {
        read_values<float>(input, TypeDesc::FLOAT, image, path);
    } else {
        read_values<std::uint16_t>(input, TypeDesc::UINT16, image, path);  // integers of 32 bits lose the lower 16
    }
    return image;
}

}  // namespace

bool can_encode(FileFormat format) { return format == FileFormat::exr || format == FileFormat::png; }

std::vector<std::byte> encode(const EncodeJob& job, const std::string& path) {
    // Create a writer to memory.
    const std::unique_ptr<ImageOutput> output = ImageOutput::create(row_of(job.format).openimageio);
    if (!output) throw FileError(path, "cannot be written: " + message(OIIO::geterror()));
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    // Write the picture and its facts.
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

StoredImage decode(FileFormat format, std::span<const std::byte> bytes, const std::string& path, int most) {
    if (row_of(format).openimageio == nullptr) return decode_stb(format, bytes, path, most);
    BoundedReader memory(bytes);
    return read(*open(format, memory, path), bytes.size(), path, most);
}

ImageInfo decode_header(FileFormat format, std::span<const std::byte> bytes, const std::string& path) {
    if (row_of(format).openimageio == nullptr)
        return decode_info_stb(format, bytes, path);  // encode() doesn't write facts to these formats
    BoundedReader memory(bytes);
    const ImageSpec spec = open(format, memory, path)->spec();
    ImageInfo info{.width = spec.width, .height = spec.height, .channels = {}, .facts = read_facts(spec)};
    const PartOf part{spec.x - spec.full_x, spec.y - spec.full_y, spec.full_width, spec.full_height};
    if (format == FileFormat::exr && part != PartOf{0, 0, spec.width, spec.height}) info.part_of = part;
    for (int i = 0; i < spec.nchannels; ++i)
        info.channels.push_back({std::string(spec.channel_name(i)), spec.channelformat(i).c_str()});
    return info;
}

}  // namespace limn
