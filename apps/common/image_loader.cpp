// The image codec of limn's programs. It is in a module that is loaded when the first picture is read or written,
// because OpenImageIO depends on 260 libraries, which take at least a fifth of a second to load.
#include "io/image_codec.h"
#include "module.h"

namespace limn {

namespace {

// Returns the codec, and loads its module at the first call. \throws Error if the module cannot be loaded
const ImageCodec& codec() {
    static const auto* const loaded = static_cast<const ImageCodec*>(app::load_module("limn_openimageio"));
    return *loaded;
}

}  // namespace

// This is called before a picture is rendered, so a missing module is reported early.
bool can_encode(FileFormat format) { return codec().can_encode(format); }

std::vector<std::byte> encode(const EncodeJob& job, const std::string& path) { return codec().encode(job, path); }

StoredImage decode(FileFormat format, std::span<const std::byte> bytes, const std::string& path, int most) {
    return codec().decode(format, bytes, path, most);
}

ImageInfo decode_header(FileFormat format, std::span<const std::byte> bytes, const std::string& path) {
    return codec().decode_header(format, bytes, path);
}

}  // namespace limn
