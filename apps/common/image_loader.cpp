// The codec of limn's programs: that of a module, which is loaded when a picture is to be read or written. OpenImageIO
// comes with 260 libraries, which take a fifth of a second and more to load.
#include "io/image_codec.h"
#include "module.h"

namespace limn {

namespace {

const ImageCodec& codec() {
    static const auto* const loaded = static_cast<const ImageCodec*>(app::load_module("limn_openimageio"));
    return *loaded;
}

}  // namespace

// Called before a picture is rendered, so that a missing module is reported in time.
bool can_encode(FileFormat format) { return codec().can_encode(format); }

std::vector<std::byte> encode(const EncodeJob& job, const std::string& path) { return codec().encode(job, path); }

StoredImage decode(FileFormat format, std::span<const std::byte> bytes, const std::string& path, int most) {
    return codec().decode(format, bytes, path, most);
}

ImageInfo decode_header(FileFormat format, std::span<const std::byte> bytes, const std::string& path) {
    return codec().decode_header(format, bytes, path);
}

}  // namespace limn
