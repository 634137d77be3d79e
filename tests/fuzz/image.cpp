// Whatever the bytes of a picture are, each way to read them gives a result or a FileError. The checksums of a PNG are
// made right, so that what is within reaches the decoder.
#include <cstdint>
#include <span>

#include "io/make_png.h"
#include "limn/io/image_io.h"
#include "limn/math/error.h"
#include "scratch_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string text(reinterpret_cast<const char*>(data), size);
    if (text.starts_with("\x89PNG")) text = limn::test::with_checksums(text);
    const std::span<const std::byte> bytes = std::as_bytes(std::span(text));
    limn::fuzz::attempt<limn::FileError>([&] { limn::load_image_from_memory(bytes); });
    limn::fuzz::attempt<limn::FileError>([&] { limn::load_alpha_from_memory(bytes); });
    limn::fuzz::attempt<limn::FileError>([&] { limn::load_image_info_from_memory(bytes); });
    return 0;
}
