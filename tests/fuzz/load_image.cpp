// Whatever the bytes of a picture are, each way to read them gives a result or a FileError. The checksums of a PNG are
// made right, so that what is within reaches the decoder.
#include <cstdint>
#include <span>

#include "io/make_png.h"
#include "limn/core/error.h"
#include "limn/io/image_io.h"
#include "scratch_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::string path = limn::fuzz::scratch_path("picture");
    std::string bytes(reinterpret_cast<const char*>(data), size);
    if (bytes.starts_with("\x89PNG")) bytes = limn::test::with_checksums(bytes);
    limn::fuzz::write_file(path, bytes);
    limn::fuzz::attempt<limn::FileError>([&] { limn::load_image(path); });
    limn::fuzz::attempt<limn::FileError>([&] { limn::load_image_from_memory(std::as_bytes(std::span(bytes))); });
    limn::fuzz::attempt<limn::FileError>([&] { limn::load_image_info(path); });
    limn::fuzz::attempt<limn::FileError>([&] { limn::load_image_facts(path); });
    return 0;
}
