// Whatever the bytes of a glTF or .glb are, reading them gives a model or a refusal. What it names is beside a file
// that is not there.
#include <cstdint>

#include "io/bytes.h"
#include "io/model_reader.h"
#include "limn/math/error.h"
#include "scratch_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    limn::fuzz::attempt<limn::FileError>([&] {
        limn::fuzz::attempt<limn::Fault>([&] { limn::read_gltf(bytes, "no/such/folder/a.gltf", {.crease = 30}); });
    });
    return 0;
}
